"""A person in a test: leads a run of real nodes by its services, on a master of the test."""
import os
import subprocess
import time

import flying
from monarch_flight.runs import master


class Leader(flying.FlightTest):
    def setUp(self):
        super().setUp()
        environment = self.environment(ROS_MASTER_URI=self.master, ROS_HOSTNAME="localhost",
                                       PATH="/usr/bin:" + os.environ["PATH"])
        core = subprocess.Popen(["roscore", "-p", self.master.rsplit(":", 1)[1]],
                                stdout=subprocess.DEVNULL, env=environment)
        self.addCleanup(self.end, core)
        self.wait_for(lambda: master.answers(self.master), 30, "roscore")
        os.environ.update(ROS_MASTER_URI=self.master, ROS_HOSTNAME="localhost")
        # On wall time: a held run's clock stands still.
        import rospy
        rospy.init_node("person", disable_signals=True)

    def held_flight(self, *keys, out=None):
        """A flight that takes commands, held at its start, and how to send it one."""
        import rospy
        from monarch_flight.msg import WingbeatCommand
        publisher = rospy.Publisher("/monarch_flight/command", WingbeatCommand, queue_size=10)
        process = self.start(*keys, "guidance:=commands", "paused:=true", "out:=" + (out or self.out()),
                             ROS_MASTER_URI=self.master, ROS_HOSTNAME="localhost")
        self.good("pause")
        self.wait_for(publisher.get_num_connections, 20, "the coordinator to listen")

        def command(**fields):
            publisher.publish(WingbeatCommand(**fields))
            time.sleep(1.0)  # a held run looks for messages, too

        return process, command

    def call(self, name, *arguments):
        import rospy
        from monarch_flight.srv import FlySteps
        from std_srvs.srv import Trigger
        service = "/monarch_flight/" + name
        rospy.wait_for_service(service, 60)
        return rospy.ServiceProxy(service, FlySteps if name == "step" else Trigger)(*arguments)

    def good(self, name, *arguments):
        answer = self.call(name, *arguments)
        self.assertTrue(answer.success, answer.message)
        return answer.message
