"""Tells what a run means before it is flown: grid, resolution, Courant numbers, memory, time. The keys are those of
monarch fly."""
from monarch_flight.command import fly

add_arguments = fly.add_arguments


def run(arguments):
    return fly.fly([word for word in arguments.words if word != "plan:=true"] + ["plan:=true"])
