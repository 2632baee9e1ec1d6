"""Names in the bag of a run: the namespace in which it was flown, and the prefix of its frames."""
import dataclasses

SHARED = ("/tf", "/tf_static", "/clock", "/diagnostics", "/rosout")
STATE, TRANSFORMS = "monarch_flight/FlightState", "/tf"
BODY = "base_link"


@dataclasses.dataclass
class Names:
    space: str   # of the run, absolute, as /a/monarch_flight
    prefix: str  # of the insect's frames, as a/
    topics: list

    def remaps(self, space):
        """Words for rosbag play, with which the bag speaks as a run in the namespace `space` does."""
        outer, wanted = self.space.rpartition("/")[0], space.rpartition("/")[0]
        if self.space == space:
            return []
        own = [topic for topic in self.topics if topic not in SHARED]
        inner = [f"{topic}:={space}{topic[len(self.space):]}" for topic in own if topic.startswith(self.space + "/")]
        beside = [f"{topic}:={wanted}{topic[len(outer):]}" for topic in own
                  if topic.startswith(outer + "/") and not topic.startswith(self.space + "/")]
        return inner + beside


def prefix_of(transforms):
    """From the messages of /tf; empty where no body is in the first hundred (a bare wing)."""
    for count, message in enumerate(transforms):
        for transform in message.transforms:
            frame = transform.child_frame_id
            for end in (BODY, "right_wing"):
                if frame == end or frame.endswith("/" + end):
                    return frame[:len(frame) - len(end)].lstrip("/")
        if count == 100:
            break
    return ""


def of(path):
    """Of the bag at `path`. Raises what rosbag raises where it cannot be read."""
    import rosbag  # it comes with scripts/install fly
    with rosbag.Bag(str(path)) as bag:
        kinds = {name: info.msg_type for name, info in bag.get_type_and_topic_info().topics.items()}
        state = next((name for name, kind in kinds.items() if kind == STATE), "/monarch_flight/state")
        prefix = prefix_of(message for _, message, _ in bag.read_messages(topics=[TRANSFORMS]))
    return Names(state.rpartition("/")[0], prefix, list(kinds))
