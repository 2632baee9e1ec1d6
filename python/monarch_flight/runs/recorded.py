"""What a run's bag holds."""


def states(bag):
    """The state of every step, whatever the namespace of the run."""
    kept = bag.read_messages(connection_filter=lambda topic, kind, *_: kind == "monarch_flight/FlightState")
    return (message for _, message, _ in kept)
