// Curves by Chart.js; the same quantity of all runs in one chart, with the values at the cursor in its legend.
const dashes = [[], [6, 3], [2, 2.5], [9, 3, 2, 3]];

// {title, unit, x, scale, lines: [{name, kind, run, points}]} of all runs, by title.
function chartsOfAll() {
  const found = new Map();
  runs.forEach((run, number) => run.charts.forEach(chart => {
    if (!found.has(chart.title)) found.set(chart.title, {...chart, lines: []});
    const lines = found.get(chart.title).lines;
    chart.curves.forEach((curve, i) => {
      if (several && curve.kind === "measured" && lines.some(line => line.name === curve.name)) return;  // once is enough
      lines.push({name: curve.name, kind: curve.kind, run: number, i, x: curve.x || run.t, y: curve.y, path: chart.x === "path"});
    });
  }));
  return [...found.values()];
}

function styled(line) {
  const grey = isDark() ? "#9aa7b4" : "#7b8794";
  if (line.kind === "measured") return {borderColor: "transparent", backgroundColor: grey, pointRadius: 1.6, pointBorderWidth: 0, order: 2,
    borderWidth: 0};
  if (line.kind === "level") return {borderColor: several ? colourOf(line.run) : grey, borderDash: [3, 3], borderWidth: 1.2, pointRadius: 0, order: 1};
  return {borderColor: colourOf(several ? line.run : line.i), borderDash: several ? dashes[line.i % dashes.length] : [], borderWidth: 1.7,
    pointRadius: 0, order: 0};
}

function points(line) {
  return Array.from(line.x, (x, i) => ({x, y: Number.isFinite(line.y[i]) ? line.y[i] : null}));
}

const short = value => {
  const size = Math.abs(value);
  if (!Number.isFinite(value)) return "–";
  return size !== 0 && size < 0.01 ? value.toExponential(1) : value.toFixed(size < 1 ? 3 : size < 10 ? 2 : 1);
};

// Without the case, where it is the same of all.
const parts = runs.map(run => run.label.split(", "));
const sameCase = several && parts.every(part => part.length === 2 && part[0] === parts[0][0]);
const nameOf = run => sameCase ? parts[run][1] : runs[run].label;

class Panel {
  constructor(chart, place, goTo) {
    this.chart = chart;
    const box = document.createElement("figure");
    box.className = "chart";
    box.innerHTML = `<figcaption><h3></h3><div class="legend"></div></figcaption><div class="plot"><canvas></canvas><i class="cursor"></i></div>`;
    box.querySelector("h3").textContent = chart.title + (chart.unit ? ` [${chart.unit}]` : "");
    place.append(box);
    this.cursor = box.querySelector(".cursor");
    this.cursor.classList.toggle("point", chart.x === "path");
    this.values = chart.lines.map(line => this.entry(line, box.querySelector(".legend")));
    this.plot = new Chart(box.querySelector("canvas"), this.settings());
    box.querySelector("canvas").addEventListener("click", event => {
      if (chart.x !== "path") goTo(this.plot.scales.x.getValueForPixel(event.offsetX));
    });
  }

  entry(line, place) {
    const item = document.createElement("span"), label = document.createElement("span"), value = document.createElement("b");
    const key = document.createElement("i");
    key.className = "key " + line.kind;
    label.textContent = (several && line.kind !== "measured" ? nameOf(line.run) + ": " : "") + line.name + " ";
    item.append(key, label, value);
    place.append(item);
    return {key, value, line};
  }

  settings() {
    const path = this.chart.x === "path";
    const ends = {min: start, max: end};
    return {
      type: "line",
      data: {datasets: this.chart.lines.map(line => ({data: points(line), tension: 0, spanGaps: false, ...styled(line)}))},
      options: {
        animation: false, parsing: false, normalized: true, responsive: true, maintainAspectRatio: false, events: [],
        onResize: () => requestAnimationFrame(() => this.show(this.t)),
        layout: {padding: {right: 6}}, plugins: {legend: {display: false}, tooltip: {enabled: false}},
        scales: {
          x: {type: "linear", ...(path ? {} : ends), ticks: {maxRotation: 0, autoSkipPadding: 14, maxTicksLimit: 9}, grid: {tickLength: 4}},
          y: {type: this.chart.scale, ticks: {maxTicksLimit: 6}, grid: {tickLength: 4}, afterFit: axis => { axis.width = 52; }},
        },
      },
    };
  }

  paint() {
    const dark = isDark(), text = dark ? "#a9b4c0" : "#55606b", grid = dark ? "#2a333d" : "#e4e9ee";
    this.plot.data.datasets.forEach((set, i) => Object.assign(set, styled(this.chart.lines[i])));
    for (const axis of Object.values(this.plot.options.scales)) {
      axis.ticks.color = text;
      axis.grid.color = grid;
      axis.grid.borderColor = grid;
    }
    if (this.chart.scale === "logarithmic") this.plot.options.scales.y.ticks.callback = value => Number.isInteger(Math.log10(value)) ? value.toExponential(0) : "";
    this.values.forEach(({key, line}) => {
      const style = styled(line);
      const dash = style.borderDash && style.borderDash[0];
      key.style.borderTopStyle = !dash ? "solid" : dash < 4 ? "dotted" : "dashed";
      key.style.borderTopColor = line.kind === "measured" ? style.backgroundColor : style.borderColor;
    });
    this.plot.update("none");
  }

  // Cheap: the plot itself is not drawn again.
  show(t) {
    this.t = t;
    const area = this.plot.chartArea;
    if (!area || t === undefined) return;
    this.values.forEach(({value, line}) => {
      if (line.kind === "measured" || line.path) return;
      const {i, f} = rowAt(line.x, t), next = Math.min(i + 1, line.y.length - 1);
      value.textContent = short(line.y[i] + (f ? f * (line.y[next] - line.y[i]) : 0));
    });
    if (this.chart.x === "path") {
      this.showPlace(t);
      return;
    }
    const x = this.plot.scales.x.getPixelForValue(t);
    this.cursor.style.transform = `translate(${x}px, ${area.top}px)`;
    this.cursor.style.height = `${area.bottom - area.top}px`;
  }

  showPlace(t) {
    const line = this.chart.lines.find(one => one.kind === "flown"), {i} = rowAt(runs[line.run].t, t);
    const {x, y} = this.plot.scales;
    this.cursor.style.transform = `translate(${x.getPixelForValue(line.x[i]) - 4}px, ${y.getPixelForValue(line.y[i]) - 4}px)`;
  }
}
