// The data of the page: arrays come as base64, colours by run and by the scale of pressure.
const report = JSON.parse(document.getElementById("data").textContent);

const kinds = {"<f4": Float32Array, "i1": Int8Array};

function decoded(packed) {
  const text = atob(packed.data), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const values = new kinds[packed.type](bytes.buffer);
  values.shape = packed.shape;
  return values;
}

// Every packed array below a node becomes a typed array with a shape.
function unpacked(node) {
  if (Array.isArray(node)) return node.map(unpacked);
  if (node === null || typeof node !== "object") return node;
  if ("data" in node && node.type in kinds) return decoded(node);
  return Object.fromEntries(Object.entries(node).map(([key, value]) => [key, unpacked(value)]));
}

const runs = report.runs.map(unpacked);
const several = runs.length > 1;

// Okabe and Ito: told apart by eyes that see no red or no green.
const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9"];
const paletteDark = ["#56a9e8", "#ff8c42", "#2bc79b", "#e79ac4", "#e6c229", "#8ecbf2"];

const wantsDark = window.matchMedia("(prefers-color-scheme: dark)");
const isDark = () => (document.documentElement.dataset.theme || (wantsDark.matches ? "dark" : "light")) === "dark";
const colourOf = i => (isDark() ? paletteDark : palette)[i % palette.length];

// ColorBrewer's RdBu, reversed, as src/viz/colours.cpp.
const stops = [[33, 102, 172], [103, 169, 207], [209, 229, 240], [247, 247, 247], [253, 219, 199], [239, 138, 98], [178, 24, 43]];

function diverging(value) {  // -1 to 1
  const s = 3 * (Math.min(1, Math.max(-1, value)) + 1), i = Math.min(5, Math.floor(s)), f = s - i;
  return stops[i].map((low, k) => (low + f * (stops[i + 1][k] - low)) / 255);
}

const pressureColours = Array.from({length: 255}, (_, i) => diverging((i - 127) / 127));

// {i, f}: the row at or before t, and how far t is towards the next one.
function rowAt(times, t) {
  let low = 0, high = times.length - 1;
  if (t <= times[0]) return {i: 0, f: 0};
  if (t >= times[high]) return {i: high, f: 0};
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  return {i: low, f: (t - times[low]) / (times[low + 1] - times[low])};
}

const start = Math.min(...runs.map(run => run.t[0])), end = Math.max(...runs.map(run => run.t[run.t.length - 1]));
