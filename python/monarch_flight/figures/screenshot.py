"""A picture of a recorded flight, as rviz shows it (monarch screenshot)."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from monarch_flight import places, rviz_config
from monarch_flight.figures.screen import Screen
from monarch_flight.runs import environment, master, recorded_names

PLAYING = 15.0  # s of wall clock: a flap takes 0.1 s, so slowly, that nothing is lost on the way into the picture
MIDDLE = "1200x600+200+100"  # of the picture, without what a window draws at its edges
COLOURS = 500  # an empty window has fewer


class Stage:
    """The programs behind a picture, ended in the end; what they say is in files of `work`."""

    def __init__(self, work, base):
        self.work, self.environment, self.running = work, base, []

    def start(self, name, *command):
        with open(self.work / f"{name}.log", "w", encoding="utf-8") as log:
            self.running.append(subprocess.Popen([str(word) for word in command], stdout=log, stderr=log,
                                                 env=self.environment))

    def run(self, *command):
        """What a command says."""
        done = subprocess.run([str(word) for word in command], env=self.environment, capture_output=True, text=True,
                              check=False)
        if done.returncode:
            sys.exit(f"screenshot: {command[0]}: {(done.stderr or done.stdout).strip()}")
        return done.stdout

    def wait_for(self, seconds, what, condition):
        deadline = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > deadline:
                logs = [log.read_text(errors="replace").splitlines() for log in self.work.glob("*.log")]
                said = [line for lines in logs for line in lines[-3:]]
                sys.exit(f"screenshot: waited in vain for {what}:\n" + "\n".join(said))
            time.sleep(0.2)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self.running):
            process.terminate()
        for process in self.running:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()


def surroundings(screen, work):
    """Environment of a master of its own, and its port."""
    port = master.free_port()
    base = environment.of_flight(environment.sourced()) | screen.environment | dict(
        ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost", ROS_LOG_DIR=str(work / "log"),
        XDG_RUNTIME_DIR=str(work))
    for name in ("ROS_IP", "ROS_NAMESPACE"):  # it has the usual names
        base.pop(name, None)
    return base, port


def raise_curtain(stage, port, screen, names, theme):
    """Master, colours and rviz, listening."""
    uri = stage.environment["ROS_MASTER_URI"]
    stage.start("core", "roscore", "-p", port)
    stage.wait_for(30, "the ROS master", lambda: master.answers(uri))
    stage.run("rosparam", "set", "/use_sim_time", "true")
    stage.start("flow", places.program("flow_view"))
    config = stage.work / "monarch.rviz"
    config.write_text(rviz_config.config(theme, names.prefix, size=screen.size), encoding="utf-8")
    stage.start("rviz", "rviz", "--fullscreen", "-d", config, "__name:=rviz")
    stage.wait_for(60, "rviz", lambda: master.listens(uri, "/rviz", "/monarch_flight/path"))
    stage.wait_for(30, "the wings' colours",
                   lambda: master.listens(uri, "/monarch_flight/flow_view", "/monarch_flight/right_wing/pressure"))


class Camera:
    """Pictures of the display, until two in a row are the same and show more than an empty window."""

    def __init__(self, stage):
        self.stage, self.now, self.before = stage, stage.work / "now.png", stage.work / "before.png"

    def colours(self):
        return int(self.stage.run("identify", "-format", "%k", self.now))

    def same(self):
        pictures = (str(self.before), str(self.now))
        done = subprocess.run(["compare", "-metric", "AE", "-extract", MIDDLE, *pictures, "null:"], env=self.stage.environment,
                              capture_output=True, text=True, check=False)
        return done.stderr.strip() == "0"

    def still(self):
        if self.now.exists():
            self.now.replace(self.before)
        self.stage.run("import", "-window", "root", self.now)
        time.sleep(1.0)
        return self.before.exists() and self.colours() > COLOURS and self.same()


def take(bag, picture, seconds, theme="dark", size="1600x900"):
    """Writes the picture of a bag after so many seconds of flight (None: at its end)."""
    names = recorded_names.of(bag)
    with tempfile.TemporaryDirectory(prefix="screenshot_") as name:
        work = pathlib.Path(name)
        with Screen(size) as screen:
            base, port = surroundings(screen, work)
            with Stage(work, base) as stage:
                raise_curtain(stage, port, screen, names, theme)
                length = seconds or float(stage.run("rosbag", "info", "-y", "-k", "duration", bag))
                print(f"screenshot: replaying {length:g} s of flight", flush=True)
                stage.run("rosbag", "play", "-q", "-r", length / PLAYING or 1.0, "-u", length, bag,
                          *names.remaps("/monarch_flight"))
                camera = Camera(stage)
                stage.wait_for(60, "the picture to stand still", camera.still)
                shutil.copy(camera.now, picture)
    print(f"screenshot: {picture}")
