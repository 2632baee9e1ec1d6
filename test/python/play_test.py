"""The player of a replay waits for rviz, but not for ever."""
import contextlib
import io
import pathlib
import sys
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scripts")]
try:
    import play
except ImportError as error:  # rosbag comes with scripts/install fly
    raise unittest.SkipTest(str(error))


class AwaitRviz(unittest.TestCase):
    def told(self, answers, patience=20.0, **environment):
        """What it says while the master gives these answers, and what the master was asked."""
        said = io.StringIO()
        with mock.patch.object(play, "listens", side_effect=answers) as asked, mock.patch.object(play, "PATIENCE", patience), \
                mock.patch("time.sleep"), mock.patch.dict("os.environ", environment), contextlib.redirect_stdout(said):
            play.await_rviz()
        return said.getvalue(), asked

    def test_it_waits_until_rviz_listens(self):
        said, asked = self.told([False, False, True], ROS_MASTER_URI="http://there:1", ROS_NAMESPACE="")
        self.assertEqual(asked.mock_calls, 3 * [mock.call("http://there:1", "/rviz", "/monarch_flight/path")])
        self.assertEqual(said, "play: waiting for rviz, at most 20 s\n")

    def test_it_asks_for_the_rviz_of_its_namespace(self):
        _, asked = self.told([True], ROS_MASTER_URI="http://there:1", ROS_NAMESPACE="/a")
        asked.assert_called_once_with("http://there:1", "/a/rviz", "/a/monarch_flight/path")

    def test_it_begins_without_rviz(self):
        said, _ = self.told([False, False], patience=-1.0)
        self.assertIn("begins without it", said)


if __name__ == "__main__":
    unittest.main()
