"""Finds a periodic flight of a case, fits masses or the spring, or designs a controller, and stores it as a case file.

As monarch trim climb_printed fit:=kappa:1e-4:2e-4 climb:=23.4 out:=my_case.yaml
   monarch trim climb_printed control:=true out:=my_controlled.yaml fly:=20
The exit code is 0 only if the search converged (with control: if the flight of fly:= was held)."""
from monarch_flight import places, preparing
from monarch_flight.runs.programs import called_with_case

# Read and checked by the compiled program trim, which knows them.
KEYS = """\
keys (docs/trim.md):
  fluid           quasi_steady (default, seconds) or navier_stokes (hours)
  grid            preview, standard or fine; steps_per_flap: time steps in a flap
  wings           mirrored, or independent: all six degrees of freedom, quasi-steady air only
  start           u,w,theta_B,theta_B_dot,theta_R,theta_R_dot [m/s, rad] at the start of a flap, with independent
                  wings also v,roll,roll_dot,yaw_dot,theta_L,theta_L_dot; default: the case's
  fit             name:low:high,...: numbers to fit within a range: m_B, m_A, m_R [kg], kappa [N m/rad], theta_0 [rad],
                  root_x, root_z [m], hinge (x of the hinge axis in the outline's file)
  climb, speed, pitch, swing   to fit to: climb angle [deg], speed [m/s], mean and peak-to-peak of body pitch [deg]
  horizon         free flaps that shall each meet those targets, one shooting problem over all of them;
                  default 1: periodic flight
  run_in          prescribed flaps before the flap that is trimmed; default 0, with Navier-Stokes 1; independent wings
                  need 0
  jacobian        <out>.jacobian of an earlier trim with the same fit and targets, to begin Broyden's method with
  iterations, tolerance, difference, threads   of the search
  out             case file to write, with <out>.jacobian beside it
  fly             free flaps to fly from the result and show
  control         true: design a controller (docs/guidance.md) instead, and write the case with a section guidance into out.
                  Then climb, speed are the set point (default: the mean of the case's own motion), and these are keys, too:
    samples         of the law a flap, a divisor of the steps a flap; default 10
    inputs          two commands or more; default amplitude,deviation_mean
    lateral_inputs  with independent wings: differential commands of the lateral law; default
                    differential_deviation,differential_rest_angle
    turn            largest turn rate of the heading [deg a flap]; default 5
    time_constant   of the commands' filters [flaps]; default 0.06
    speeds, climbs  of the table of periodic flights [m/s], [deg]; default: five of each around the set point
    orbit           trim or own: the controller's reference is the periodic flight in quasi-steady air, or the case's own
                    motion; default: own where the case flies in Navier-Stokes air
    gains           trim or own: of which of these two flights; default trim"""


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="CASE | key:=value")
    parser.epilog = KEYS


def run(arguments):
    preparing.installed("fly")
    preparing.built("--programs")
    return called_with_case(places.program("trim"), arguments.words)
