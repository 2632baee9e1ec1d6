"""Reduces the markers of a measured flight to attitudes, wing angles, path and Fourier series (docs/measured.md):
writes measured.csv and measured.yaml into OUT."""
import math
import pathlib

from monarch_flight import keys, places

SECTIONS = ("figures",)


def add_arguments(parser):
    parser.add_argument("markers", nargs="?", help="table of markers; default config/measured/monarch_markers.csv")
    parser.add_argument("--out", help="folder; default flights/measured")
    parser.add_argument("--beta", type=float, default=25.4292, help="stroke plane angle [deg]; default 25.4292")


def run(arguments):
    import yaml

    from monarch_flight.measured import marker_reduction as reduction
    from monarch_flight.measured import reduced
    try:
        t, markers = reduction.read_markers(arguments.markers or places.config() / "measured/monarch_markers.csv")
    except (OSError, reduction.InputError) as error:
        raise keys.Refused(str(error)) from error
    result = reduction.reduce(t, markers, math.radians(arguments.beta))
    summary = reduced.write(result, pathlib.Path(arguments.out or places.flights() / "measured"))
    print(f"velocity {summary['velocity']} m/s NED, speed {summary['speed']:.3f} m/s, climb "
          f"{summary['climb_deg']:.1f} deg, stroke plane {summary['beta_deg']:.1f} deg")
    published = yaml.safe_load((places.config() / "insects/monarch_kinematics.yaml").read_text(encoding="utf-8"))
    print("angle     rms to the published series [deg]   mean, published   frequency, published")
    for name, rms, mean, mean_p, f, f_p in reduced.compare(result, published, reduced.FREQUENCIES):
        print(f"{name:8s}  {rms:6.2f}                            {mean:7.2f} {mean_p:7.2f}   {f:8.3f} {f_p:8.3f}")
