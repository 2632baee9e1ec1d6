"""What rviz shows of a flight: rviz/monarch.rviz in the colours of a theme, for a namespace and a prefix of frames."""
import yaml

from monarch_flight import places

PANEL = "monarch_flight/FlightPanel"
TOPICS = ("Topic", "Marker Topic")
FRAMES = ("Reference Frame", "Target Frame")
SHARED = ("world", "world_ned", "<Fixed Frame>")  # frames that are everybody's
OWN = "monarch_flight/"  # before the names of a run's topics
LIGHT = {"Background Color": "222; 227; 234"}
LIGHT_DISPLAYS = {"Ground grid (5 cm)": "140; 147; 158", "Path": "30; 130; 70", "Measured path": "176; 120; 20"}
THEMES = ("dark", "light")


def has_panel():
    """Whether the panel was built; rviz would show an error in its place."""
    if places.prefix() is None:
        return False
    library = places.prefix() / "lib"
    return any((folder / "libmonarch_flight_panel.so").is_file() for folder in (library, *library.glob("*-linux-gnu")))


def sections(part):
    """Every section of a config, itself included."""
    if isinstance(part, dict):
        yield part
        for value in part.values():
            yield from sections(value)
    elif isinstance(part, list):
        for value in part:
            yield from sections(value)


def named(config, prefix, space):
    """`prefix`: before the names of the insect's frames, as a/; `space`: absolute namespace of the run, as
    /a/monarch_flight; empty: that of rviz itself."""
    for section in sections(config):
        for key in FRAMES:
            if section.get(key) and section[key] not in SHARED:
                section[key] = prefix + section[key]
        for key in TOPICS:
            if space and str(section.get(key)).startswith(OWN):
                section[key] = f"{space}/{section[key][len(OWN):]}"
        if space and section.get("Class") == PANEL:
            section["Namespace"] = space


def lit(config):
    """In the colours of paper."""
    manager = config["Visualization Manager"]
    manager["Global Options"].update(LIGHT)
    for display in manager["Displays"]:
        if display["Name"] in LIGHT_DISPLAYS:
            display["Color"] = LIGHT_DISPLAYS[display["Name"]]


def config(theme="dark", prefix="", space="", panel=None, size=None):
    """The text of the config. `panel`: with the panel of a flight; None: where it was built. `size`: of the window, as
    1600x900."""
    with open(places.share() / "rviz/monarch.rviz", encoding="utf-8") as file:
        wanted = yaml.safe_load(file)
    named(wanted, prefix, space)
    if theme == "light":
        lit(wanted)
    if not (has_panel() if panel is None else panel):
        wanted["Panels"] = [one for one in wanted["Panels"] if one["Class"] != PANEL]
    if size:
        wanted["Window Geometry"].update(zip(("Width", "Height"), map(int, size.split("x"))))
    return yaml.safe_dump(wanted, sort_keys=False, width=100000)
