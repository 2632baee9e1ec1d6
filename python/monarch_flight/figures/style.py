"""The one style of all figures: colours, and matplotlib without a screen. Imported before pyplot draws anything."""
import matplotlib

matplotlib.use("Agg")
OURS, THEIRS, MEASURED, THIRD = "#0072b2", "#d55e00", "#1b2229", "#009e73"  # Okabe and Ito: safe for all eyes
GREY, FAINT = "#7b8794", "#b4bdc6"
matplotlib.rcParams.update({
    "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "font.size": 9, "axes.titlesize": 10, "axes.titleweight": "medium",
    "axes.titlelocation": "left", "axes.labelsize": 9, "axes.labelcolor": "#3b444d", "axes.edgecolor": FAINT, "axes.linewidth": 0.8,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#e4e9ee", "grid.linewidth": 0.8,
    "axes.axisbelow": True, "axes.prop_cycle": matplotlib.cycler(color=[OURS, THEIRS, THIRD, "#cc79a7", "#b8860b", "#56b4e9"]),
    "xtick.color": "#55606b", "ytick.color": "#55606b", "xtick.labelsize": 8, "ytick.labelsize": 8, "lines.linewidth": 1.5,
    "legend.fontsize": 8, "legend.edgecolor": "white", "legend.framealpha": 0.85, "legend.fancybox": False,
    "figure.titlesize": 11, "savefig.dpi": 160, "savefig.facecolor": "white"})
