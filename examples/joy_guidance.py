#!/usr/bin/python3
"""Leads the wingbeat of a flight by hand, from the keyboard and a joystick: publishes
/monarch_flight/command (docs/guidance.md).

  scripts/fly case:=climb_trimmed fluid:=quasi_steady flaps:=200 guidance:=commands
  ROS_MASTER_URI=<address in its first lines> rosrun monarch_flight joy_guidance.py

In a terminal, keys change the commands by a tenth of their range. A joystick comes from the topic
`joy` (sensor_msgs/Joy), or is read by this node: _device:=/dev/input/js0. What a stick commands
goes with its axis; a command stays when this node ends. Parameters, as _amplitude_axis:=1:
  <command>_axis          axis of the joystick that commands it; -1: none
  <command>_range         command at the end of the axis, relative or [rad]
  zero_button, at_once_button   the first takes all commands back, the second is the key o
  dead_zone               part of an axis about its middle that counts as the middle
  keyboard                true or false; default true in a terminal
"""
import os
import select
import signal
import struct
import sys
import termios
import threading
import time
import tty
from math import degrees

# Reached from this machine only, unless the person has given the node an address.
if "ROS_IP" not in os.environ:
    os.environ.setdefault("ROS_HOSTNAME", "localhost")

import rospy  # noqa: E402  (reads the address when it is imported)
from monarch_flight.msg import WingbeatCommand
from sensor_msgs.msg import Joy

# command: its axis (left stick up and aside, right stick up and aside of most joysticks), its
# range, the keys for more and less, how it is shown
COMMANDS = {
    "amplitude": (1, 0.25, "ed", lambda x: "%+.1f %%" % (100 * x)),
    "deviation_mean": (4, 0.1047, "rf", lambda x: "%+.2f deg" % degrees(x)),
    "frequency": (3, 0.25, "tg", lambda x: "%+.1f %%" % (100 * x)),
    "flapping_mean": (0, 0.4363, "yh", lambda x: "%+.1f deg" % degrees(x)),
}
HELP = "".join("  %s %s  %s more, less\n" % (*keys, name)
               for name, (_, _, keys, _) in COMMANDS.items()) + (
    "  space  all commands back to zero\n"
    "  o  at once: in the next step, not when the next flap begins\n"
    "  q  end; the commands stay\n")


def parameter(name, default):
    return rospy.get_param("~" + name, default)


class Pilot:
    """What is commanded now; axes and keys change it."""

    def __init__(self):
        self.axis = {name: parameter(name + "_axis", c[0]) for name, c in COMMANDS.items()}
        self.range = {name: parameter(name + "_range", c[1]) for name, c in COMMANDS.items()}
        self.zero_button = parameter("zero_button", 0)
        self.at_once_button = parameter("at_once_button", 5)
        self.dead_zone = parameter("dead_zone", 0.05)
        self.lock = threading.Lock()  # joystick and keyboard have a thread each
        self.axes, self.buttons = [], []
        self.command, self.sent = WingbeatCommand(), WingbeatCommand()
        self.publisher = rospy.Publisher("monarch_flight/command", WingbeatCommand, latch=True,
                                         queue_size=10, tcp_nodelay=True)
        rospy.Subscriber("joy", Joy, lambda joy: self.on_joystick(joy.axes, joy.buttons))

    def on_joystick(self, axes, buttons):
        """A stick that has not moved leaves its command to the keys."""
        axes = [x if abs(x) > self.dead_zone else 0.0 for x in axes]
        with self.lock:
            for name, i in self.axis.items():
                if 0 <= i < len(axes) and axes[i] != (self.axes[i] if i < len(self.axes) else 0.0):
                    setattr(self.command, name, axes[i] * self.range[name])
            pressed = {i for i, down in enumerate(buttons) if down} - {
                i for i, down in enumerate(self.buttons) if down}
            self.axes, self.buttons = axes, list(buttons)
            if self.zero_button in pressed:
                self.zero()
            if self.at_once_button in pressed:
                self.command.at_once = not self.command.at_once
            self.send()

    def on_key(self, key):
        """Returns whether to go on."""
        with self.lock:
            for name, (_, _, keys, _) in COMMANDS.items():
                if key in keys:
                    top = self.range[name]
                    wanted = getattr(self.command, name) + top / 10 * (1 if key == keys[0] else -1)
                    setattr(self.command, name, min(max(wanted, -top), top))
            if key == " ":
                self.zero()
            if key == "o":
                self.command.at_once = not self.command.at_once
            self.send()
        return key != "q"

    def zero(self):
        self.command = WingbeatCommand(at_once=self.command.at_once)
        self.sent = None  # so that it goes out, whoever has commanded before

    def send(self):
        if self.command == self.sent:
            return
        self.sent = WingbeatCommand(*(getattr(self.command, f) for f in self.command.__slots__))
        self.publisher.publish(self.sent)
        self.show()

    def show(self):
        if sys.stdout.isatty():
            text = "  ".join("%s %s" % (name, show(getattr(self.command, name)))
                             for name, (_, _, _, show) in COMMANDS.items())
            print("\r%s%s\x1b[K" % (text, "  at once" if self.command.at_once else ""), end="",
                  flush=True)


def read_joystick(device, pilot):
    """Events of the kernel's joystick interface: time, value, kind, number. Up and left are
    positive, as in sensor_msgs/Joy."""
    axes, buttons = [0.0] * 32, [0] * 32
    with open(device, "rb", buffering=0) as events:
        while True:
            event = events.read(8)
            if len(event) < 8:
                rospy.logerr("%s: the joystick has gone", device)
                return
            _, value, kind, number = struct.unpack("IhBB", event)
            if number < 32 and kind & 0x7f == 1:
                buttons[number] = value
            elif number < 32 and kind & 0x7f == 2:
                axes[number] = -value / 32767
            pilot.on_joystick(axes, buttons)


def read_keys(pilot):
    """Until q; the terminal is left as it was found, whatever happens."""
    terminal = sys.stdin.fileno()
    before = termios.tcgetattr(terminal)
    print(HELP)
    try:
        tty.setcbreak(terminal)
        pilot.show()
        while not rospy.is_shutdown():
            if select.select([terminal], [], [], 0.2)[0]:
                key = os.read(terminal, 1)
                if not key or not pilot.on_key(key.decode("ascii", "ignore")):
                    return
    finally:
        termios.tcsetattr(terminal, termios.TCSADRAIN, before)
        print()


def main():
    rospy.init_node("joy_guidance", anonymous=True, disable_signals=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    pilot = Pilot()
    device = parameter("device", "")
    if device:
        threading.Thread(target=read_joystick, args=(device, pilot), daemon=True).start()
    try:
        if parameter("keyboard", sys.stdin.isatty()):
            read_keys(pilot)
        else:
            while not rospy.is_shutdown():
                time.sleep(0.2)
    except KeyboardInterrupt:
        return 130
    finally:
        time.sleep(0.2)  # the last command is still on its way
        rospy.signal_shutdown("the end")
    return 0


if __name__ == "__main__":
    sys.exit(main())
