#!/usr/bin/python3
"""A slider for every joint of the model in robot_description, published on joint_states (display.launch)."""
import math
import tkinter
import xml.etree.ElementTree

import rospy
from sensor_msgs.msg import JointState

PERIOD_MS = 40


def joints(urdf):
    """Names of what can turn."""
    return [joint.get("name") for joint in xml.etree.ElementTree.fromstring(urdf).iter("joint")
            if joint.get("type") != "fixed"]


def window(names):
    """The window, and the angle of each joint [deg]."""
    root = tkinter.Tk()
    root.title("Joints [deg]")
    angles = {name: tkinter.DoubleVar(root) for name in names}
    for row, (name, angle) in enumerate(angles.items()):
        tkinter.Label(root, text=name).grid(row=row, column=0, sticky="se")
        tkinter.Scale(root, variable=angle, from_=-120, to=120, orient="horizontal", length=300).grid(row=row, column=1)
    centre = tkinter.Button(root, text="all to zero", command=lambda: [angle.set(0) for angle in angles.values()])
    centre.grid(row=len(names), column=1)
    return root, angles


def main():
    rospy.init_node("joint_sliders", disable_signals=True)
    root, angles = window(joints(rospy.get_param("robot_description")))
    publisher = rospy.Publisher("joint_states", JointState, queue_size=5)

    def publish():
        if rospy.is_shutdown():
            root.destroy()
            return
        state = JointState(name=list(angles), position=[math.radians(angle.get()) for angle in angles.values()])
        state.header.stamp = rospy.Time.now()
        publisher.publish(state)
        root.after(PERIOD_MS, publish)

    publish()
    root.mainloop()


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
