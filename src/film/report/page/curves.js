// Curves over the frames of the film, one below the other, with one line through all of them where the film stands.

const MARGIN = { left: 62, right: 14, top: 8, bottom: 6 };

/** What each frame took, of what all took until then; of frames that begin anew, as those of another class do, all of it. */
function eachFrame(sums) {
  return sums.map((sum, k) => (k > 0 && sum >= sums[k - 1] ? sum - sums[k - 1] : sum));
}

/** A diagram: what it is of, its curves, and how their values are written. */
function panels() {
  const c = facts.curves;
  const list = [{
    title: "length error", log: true, least: 1e-7, write: percent,
    curves: [["max", c.max, "warm"], ["p95", c.p95, "faint"], ["mean", c.mean, "cool"]],
  }];
  if (c.rims.some(Boolean)) {
    list.push({ title: "rims", write: short, curves: [["rims", c.rims, "warm"], ["born", c.born, "faint"], ["died", c.died, "cool"]] });
  }
  if (c.events?.some(Boolean)) list.push({ title: "folds and faces that vanish", write: short, curves: [["since the frame before", c.events, "warm"]] });
  if (c.pinchPoints.some(Boolean)) list.push({ title: "pinch points", write: short, curves: [["pinch points", c.pinchPoints, "warm"]] });
  list.push({ title: "energy", log: true, least: 1e-9, write: short, curves: [["bending", c.bending, "warm"], ["torsion", c.torsion, "faint"], ["rotation", c.rotation, "cool"]] });
  const bend = [["angle between faces", c.bend, "warm"]];
  if (c.bendError) bend.push(["from its target", c.bendError, "cool"]);
  list.push({ title: "bending", write: (x) => `${short(x)}°`, curves: bend });
  list.push({ title: "steps", write: short, curves: [["steps", eachFrame(c.steps), "warm"]] });
  if (c.iterations.some(Boolean)) list.push({ title: "inner iterations", write: short, curves: [["inner iterations", eachFrame(c.iterations), "cool"]] });
  return list;
}

class Curves {
  constructor(viewer) {
    this.viewer = viewer;
    this.frames = facts.curves.frame;
    this.list = panels();
    this.element = make("section", { class: "curves", "aria-label": "Curves" }, make("h2", {}, "Over the film"));
    this.cursors = [];
    for (const panel of this.list) this.element.append(this.panel(panel));
    this.element.append(make("p", { class: "note" },
      "Energies are those of the frames without target angles, with the weights of the last phase.", make("span", { class: "hint" }, " Press anywhere in a diagram to go there.")));
    new ResizeObserver(() => this.plot()).observe(this.element);
    this.plot();
    viewer.listen((place) => this.show(place));
  }

  panel(panel) {
    panel.values = panel.curves.map(([name, , color]) => {
      panel.readings ??= [];
      const value = make("b", {});
      panel.readings.push(value);
      return make("span", { class: color }, panel.curves.length > 1 ? `${name} ` : "", value);
    });
    panel.svg = draw("svg", { role: "img", "aria-label": panel.title, class: "plot" });
    const go = (event) => {
      if (event.buttons !== 1 && event.type !== "pointerdown") return;
      const box = panel.svg.getBoundingClientRect();
      const part = (event.clientX - box.left - MARGIN.left) / (box.width - MARGIN.left - MARGIN.right);
      const wanted = this.frames[0] + part * (this.frames.at(-1) - this.frames[0]);
      const shown = this.viewer.frames;
      let nearest = 0;
      shown.forEach((frame, k) => { if (Math.abs(frame - wanted) < Math.abs(shown[nearest] - wanted)) nearest = k; });
      this.viewer.pause();
      this.viewer.go(nearest);
    };
    panel.svg.addEventListener("pointerdown", go);
    panel.svg.addEventListener("pointermove", go);
    return make("div", { class: "panel" }, make("div", { class: "heading" }, make("h3", {}, panel.title), panel.values), panel.svg);
  }

  across(frame) {
    const [first, last] = [this.frames[0], this.frames.at(-1)];
    return MARGIN.left + ((frame - first) / Math.max(1, last - first)) * (this.width - MARGIN.left - MARGIN.right);
  }

  plot() {
    const width = Math.round(this.element.clientWidth) || 640;
    if (width === this.width) return;
    this.width = width;
    this.list.forEach((panel, k) => this.plotPanel(panel, k === this.list.length - 1));
    this.show(this.viewer.place);
  }

  plotPanel(panel, isLast) {
    const height = 116 + (isLast ? 18 : 0);
    const { svg, log } = panel;
    svg.setAttribute("viewBox", `0 0 ${this.width} ${height}`);
    svg.style.height = `${height}px`;
    const bottom = height - MARGIN.bottom - (isLast ? 18 : 0);
    const value = (x) => (log ? Math.log10(Math.max(x, panel.least)) : x);
    const all = panel.curves.flatMap(([, values]) => values).filter((x) => x != null && (!log || x > 0)).map(value);
    let [low, high] = log ? [Math.floor(Math.min(...all)), Math.ceil(Math.max(...all))] : [Math.min(0, ...all), Math.max(...all)];
    if (!Number.isFinite(low)) [low, high] = [0, 1];
    if (high <= low) high = low + 1;
    const ticks = log ? decades(low, high) : rounds(low, high, 3, panel.write === short ? 1 : 0);
    if (!log) high = Math.max(high, ticks.at(-1));
    const up = (x) => bottom - ((x - low) / (high - low)) * (bottom - MARGIN.top);
    svg.replaceChildren();
    for (const tick of ticks) {
      svg.append(draw("line", { class: "grid", x1: MARGIN.left, x2: this.width - MARGIN.right, y1: up(tick), y2: up(tick) }),
        draw("text", { x: MARGIN.left - 8, y: up(tick) + 4, "text-anchor": "end" }, panel.write(log ? 10 ** tick : tick)));
    }
    if (isLast) {
      for (const tick of rounds(this.frames[0], this.frames.at(-1), this.width < 500 ? 4 : 8).map(Math.round).filter((x) => x >= this.frames[0] && x <= this.frames.at(-1)))
        svg.append(draw("text", { x: this.across(tick), y: height - 6, "text-anchor": "middle" }, `${tick}`));
      svg.append(draw("text", { x: MARGIN.left - 8, y: height - 6, "text-anchor": "end" }, "frame"));
    }
    for (const [, values, color] of panel.curves) {
      const points = values.map((x, k) => (x == null ? null : `${this.across(this.frames[k]).toFixed(1)},${up(Math.max(low, value(x))).toFixed(1)}`));
      if (values.length === 1) svg.append(draw("circle", { class: `dot ${color}`, cx: this.across(this.frames[0]), cy: up(value(values[0])), r: 3 }));
      else svg.append(draw("polyline", { class: color, points: points.filter(Boolean).join(" ") }));
    }
    panel.cursor = draw("line", { class: "cursor", y1: MARGIN.top, y2: bottom });
    svg.append(panel.cursor);
  }

  show(place) {
    const number = this.viewer.frames[place];
    const x = this.across(number);
    for (const panel of this.list) {
      panel.cursor?.setAttribute("x1", x);
      panel.cursor?.setAttribute("x2", x);
      panel.curves.forEach(([, values], k) => { panel.readings[k].textContent = panel.write(values[number - 1]); });
    }
  }
}

/** Powers of ten, as exponents, at most five. */
function decades(low, high) {
  const step = Math.max(1, Math.ceil((high - low) / 4));
  return Array.from({ length: Math.floor((high - low) / step) + 1 }, (_, k) => low + k * step);
}

/** Numbers that read well, about so many, and as far apart as `finest` or farther. */
function rounds(low, high, count = 3, finest = 0) {
  const least = Math.max(finest, (high - low) / count) || 1;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= least * 0.999);
  const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(1, last - first + 1) }, (_, k) => (first + k) * step);
}

/** How many edges have length errors of which size, in the frame that is shown. */
class Distribution {
  constructor(viewer) {
    this.viewer = viewer;
    this.svg = draw("svg", { role: "img", "aria-label": "Distribution of length errors", class: "plot" });
    this.caption = make("p", { class: "note" });
    this.element = make("section", { class: "distribution" }, make("h2", {}, "Distribution of the length error"), this.svg, this.caption);
    new ResizeObserver(() => this.show(this.viewer.place)).observe(this.element);
    viewer.listen((place) => this.show(place));
  }

  show(place) {
    const { bins, binsADecade, least } = facts.histogram;
    const number = this.viewer.frames[place];
    const counts = this.viewer.film.histogram.subarray(bins * (number - 1), bins * number);
    const all = counts.reduce((sum, x) => sum + x, 0) || 1;
    const most = Math.max(...counts, 1);
    const width = Math.round(this.element.clientWidth) || 640;
    const [left, right, top, height] = [14, 14, 6, 150];
    const bottom = height - 22;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.svg.style.height = `${height}px`;
    const across = (bin) => left + (bin / bins) * (width - left - right);
    const bars = Array.from(counts, (count, k) => draw("rect", {
      class: "bar", x: across(k) + 0.5, width: Math.max(0.5, across(k + 1) - across(k) - 1),
      y: bottom - (count / most) * (bottom - top), height: (count / most) * (bottom - top),
    }));
    const labels = [];
    for (let k = 0; k <= bins; k += binsADecade) {
      if (width < 500 && (k / binsADecade) % 2 === 1) continue;
      const label = percent(10 ** (least + k / binsADecade));
      labels.push(draw("text", { x: across(k), y: height - 6, "text-anchor": k === 0 ? "start" : k === bins ? "end" : "middle" }, label));
    }
    const c = facts.curves;
    const stand = (value, color) => {
      const bin = Math.min(bins, Math.max(0, (Math.log10(value || 1e-99) - least) * binsADecade));
      return draw("line", { class: `stand ${color}`, x1: across(bin), x2: across(bin), y1: top, y2: bottom });
    };
    this.svg.replaceChildren(draw("line", { class: "grid", x1: left, x2: width - right, y1: bottom, y2: bottom }), ...bars, ...labels,
      stand(c.mean[number - 1], "cool"), stand(c.p95[number - 1], "faint"), stand(c.max[number - 1], "warm"));
    this.caption.textContent = `Frame ${number}: ${counted(all, "edge")}, mean ${percent(c.mean[number - 1])}, 95 of 100 below ${percent(c.p95[number - 1])}, ` +
      `the largest ${percent(c.max[number - 1])}. Errors are absolute values of relative errors, six bins a decade.`;
  }
}
