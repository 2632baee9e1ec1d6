// Time: plays, scrubs, and tells the view and the curves.
(function () {
  const $ = id => document.getElementById(id);
  const rates = [1 / 1000, 1 / 500, 1 / 200, 1 / 100, 1 / 50, 1 / 20, 1 / 10, 1 / 5, 1 / 2, 1, 2, 5];
  const perSecond = report.beats ? report.frequency : 1;  // of the page's time in a second of flight
  const nearest = wanted => rates.reduce((best, rate) => Math.abs(Math.log(rate / wanted)) < Math.abs(Math.log(best / wanted)) ? rate : best);
  const clock = {t: start, playing: false, rate: nearest(report.beats ? 0.5 / report.frequency : (end - start) / 12), last: 0};
  let view = null;
  try {
    view = drawing($("view"));
  } catch (error) {
    $("no-view").hidden = false;
    console.warn("no WebGL: " + error.message);
  }
  const panels = chartsOfAll().map(chart => new Panel(chart, $("charts"), goTo));
  window.monarchReport = {clock, runs, panels};  // for whoever looks from the console

  function told(t) {
    const seconds = (t - start) / perSecond;
    return report.beats ? `${t.toFixed(2)} flaps · ${seconds.toFixed(3)} s` : `${t.toFixed(3)} s`;
  }

  function show() {
    if (view) view.show(clock.t);
    panels.forEach(panel => panel.show(clock.t));
    $("scrub").value = (clock.t - start) / (end - start) * 1000;
    $("time").textContent = told(clock.t);
  }

  function goTo(t) {
    clock.t = Math.min(end, Math.max(start, t));
    show();
  }

  function play(on) {
    if (on && clock.t >= end - 1e-9) clock.t = start;
    clock.playing = on;
    clock.last = 0;
    $("play").textContent = on ? "❚❚" : "▶";
    $("play").setAttribute("aria-label", on ? "pause" : "play");
  }

  function frame(now) {
    if (clock.playing) {
      if (clock.last) {
        const next = clock.t + Math.min(0.1, (now - clock.last) / 1000) * clock.rate * perSecond;
        clock.t = next > end ? start : next;
        show();
      }
      clock.last = now;
    }
    if (view) view.draw();
    requestAnimationFrame(frame);
  }

  function paint() {
    if (view) view.paint();
    panels.forEach(panel => panel.paint());
    document.querySelectorAll("[data-run]").forEach(node => node.style.setProperty("--run", colourOf(+node.dataset.run)));
    $("theme").textContent = isDark() ? "Light" : "Dark";
  }

  rates.forEach(rate => {
    const option = document.createElement("option");
    option.value = rate;
    option.textContent = rate === 1 ? "real time" : rate < 1 ? `${Math.round(1 / rate)} × slower` : `${rate} × faster`;
    option.selected = rate === clock.rate;
    $("rate").append(option);
  });
  $("rate").onchange = () => { clock.rate = +$("rate").value; };
  $("play").onclick = () => play(!clock.playing);
  $("scrub").oninput = () => { play(false); goTo(start + $("scrub").value / 1000 * (end - start)); };
  $("camera").onchange = () => { if (view) view.look($("camera").value); };
  const toggled = (id, key, after) => {
    if (!$(id)) return;
    $(id).onclick = () => {
      const on = $(id).getAttribute("aria-pressed") !== "true";
      $(id).setAttribute("aria-pressed", on);
      if (view) { view.state[key] = on; after(); show(); }
    };
  };
  toggled("pressure", "pressure", () => { $("bar").hidden = !view.state.pressure; });
  toggled("real", "real", () => {});
  toggled("apart", "apart", () => { view.arrange(); view.look($("camera").value); });
  $("theme").onclick = () => { document.documentElement.dataset.theme = isDark() ? "light" : "dark"; paint(); show(); };
  wantsDark.addEventListener("change", () => { paint(); show(); });
  document.addEventListener("keydown", event => {
    if (/^(SELECT|INPUT|SUMMARY)$/.test(event.target.tagName)) return;
    if (event.key === " " && event.target.tagName !== "BUTTON") { play(!clock.playing); event.preventDefault(); }
    if (event.key === "ArrowRight" || event.key === "ArrowLeft") {
      play(false);
      goTo(clock.t + (event.key === "ArrowRight" ? 1 : -1) * (end - start) / 400);
    }
  });
  new ResizeObserver(() => { if (view) { const turned = view.resize(); if (turned) view.look($("camera").value); } show(); }).observe($("stage"));
  paint();
  show();
  requestAnimationFrame(() => show());
  requestAnimationFrame(frame);
  if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches && !location.hash.includes("still")) play(true);
  const at = /t=([0-9.]+)/.exec(location.hash);  // page.html#still,t=2.25 opens there
  if (at) goTo(+at[1]);
})();
