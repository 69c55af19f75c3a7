// The film: its picture, which is turned by hand, and what plays it.

const DARK = {
  background: [0.0144, 0.0176, 0.0232],
  line: [0.58, 0.54, 0.48],
  rimDarkening: -0.45,
};

class Viewer {
  constructor(film) {
    this.film = film;
    this.frames = facts.frames;
    this.place = 0;
    /** Frames of the film a second, whether or not the page has all of them. */
    this.rate = facts.rate;
    this.camera = new Camera();
    this.listeners = [];
    this.build();
    try {
      this.picture = new Picture(this.canvas);
    } catch (error) {
      this.canvas.replaceWith(make("p", { class: "missing" },
        `The film cannot be shown here: ${error.message}. Curves and tables below need nothing of the kind.`));
      this.picture = null;
    }
    if (this.picture) {
      this.surface = new Surface(film);
      this.picture.table("faces", this.surface.corners, 4, "uint");
      this.hands();
      new ResizeObserver(() => this.resized()).observe(this.canvas);
      matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
      addEventListener("beforeprint", () => this.paint(true));
    }
    // What a film comes to is what one wants to see first; to play begins anew from there.
    this.go(this.frames.length - 1);
  }

  /** Is told of every frame that is shown. */
  listen(listener) {
    this.listeners.push(listener);
    listener(this.place);
  }

  build() {
    const { frames } = this;
    const look = facts.look;
    this.canvas = make("canvas", {
      tabindex: 0, role: "img", id: "film",
      "aria-label": `The film ${facts.origin.scene}. Drag to turn it; arrow keys go from frame to frame, with Shift they turn it.`,
    });
    this.legend = make("div", { class: "legend", hidden: true });
    const toggle = (text, title, value, name) => {
      const box = make("input", { type: "checkbox", checked: value, onchange: () => { this.redraw(); } });
      this.boxes[name] = box;
      return make("label", { class: "toggle", title }, box, text);
    };
    this.boxes = {};
    const choices = [make("option", { value: "" }, "two sides")].concat(
      facts.fields.map(({ name, title, unit }) => make("option", { value: name, selected: name === facts.field }, unit ? `${title} (${unit})` : title)));
    this.color = make("select", { id: "color", onchange: () => this.recolored() }, choices);
    const seeThrough = look.opacity.some((x) => x < 1) || look.edgeOpacity < 1;
    const options = [
      make("label", { class: "choice" }, "Colour ", this.color),
      toggle("See-through", "Let what is behind shine through (T)", seeThrough, "through"),
      toggle("Outlines", "Outlines and ends of the surface (O)", look.lines.silhouette > 0 || look.lines.boundary > 0, "outlines"),
      toggle("Self-intersections", "Curves in which the surface passes through itself (I)", look.lines.intersection > 0, "crossings"),
      toggle("Rims", "Edges where the surface folds over, and pinch points (U)", look.lines.rim > 0, "rims"),
      toggle("Mesh", "The edges of the mesh (M)", look.wireframe > 0, "mesh"),
    ];
    if (this.film.pins.length > 0) options.push(toggle("Pins", "Vertices that are held", look.lines.pin > 0, "pins"));
    this.play = make("button", { id: "play", type: "button", title: "Play (Space)", "aria-label": "Play", onclick: () => this.toggle() }, "▶");
    this.scrubber = make("input", {
      id: "scrubber", type: "range", min: 0, max: frames.length - 1, step: 1, value: 0, "aria-label": "Frame",
      oninput: () => { this.pause(); this.go(Number(this.scrubber.value)); },
    });
    this.marks = make("div", { class: "marks", "aria-hidden": "true" });
    this.label = make("output", { class: "frame", for: "scrubber" });
    this.reset = make("button", { id: "reset", type: "button", title: "The view of the film (R)", onclick: () => this.home() }, "Reset view");
    this.wide = make("button", { type: "button", title: "Whole screen (F)", onclick: () => this.fullscreen() }, "Whole screen");
    const bar = frames.length > 1 ? make("div", { class: "bar" }, this.play, make("div", { class: "track" }, this.scrubber, this.marks), this.label) : null;
    this.stage = make("div", { class: "stage" }, this.canvas, this.legend);
    this.element = make("figure", { class: "film" }, this.stage, bar,
      make("div", { class: "options" }, options, make("span", { class: "space" }), this.reset, this.wide),
      make("figcaption", {}, this.caption()));
    const [width, height] = facts.size;
    this.stage.style.setProperty("--aspect", `${width} / ${height}`);
  }

  caption() {
    const { step } = facts.grid;
    const left = facts.left.length > 0 ? ` There was no room for ${facts.left.map((name) => name.replaceAll("_", " ")).join(", ")}.` : "";
    const thinned = facts.frames.length < facts.measured
      ? ` The page has room for ${facts.frames.length} of the ${facts.measured} frames, evenly spread; curves have all of them.` : "";
    const fields = facts.fields.length > 0 ? " Fields have 254 steps from end to end of their legend." : "";
    const exact = `Each coordinate of a vertex is exact to ` +
      `± ${short(step / 2)} (${percent(step / 2 / facts.diagonal)} of the diagonal of the film).${fields}${thinned}${left}`;
    return [make("span", { class: "hint" }, "Drag to turn, pinch or roll the wheel to come closer, drag with Shift or two fingers to move. "), exact];
  }

  /** Marks on the track: where rims come and go, and where the surface begins or ends to pass through itself. */
  mark(events) {
    const last = Math.max(1, this.frames.length - 1);
    this.marks.replaceChildren(...events.map(({ place, kind }) => make("i", { class: kind, style: `left: ${(100 * place) / last}%` })));
  }

  go(place) {
    const last = this.frames.length - 1;
    this.place = Math.min(last, Math.max(0, place));
    this.scrubber.value = this.place;
    const number = this.frames[this.place];
    const time = facts.curves.time[number - 1];
    this.label.textContent = `${number} of ${facts.origin.frames}`;
    this.label.title = `frame ${number}, time ${short(time)}`;
    this.scrubber.setAttribute("aria-valuetext", `frame ${number}, time ${short(time)}`);
    if (this.picture) {
      this.surface.show(this.place);
      this.picture.table("places", this.surface.places, 4, "float");
      this.picture.table("normals", this.surface.normals, 4, "float");
      this.picture.table("skies", this.surface.sky, 2, "two");
      this.recolored();
    }
    for (const listener of this.listeners) listener(this.place);
  }

  get field() {
    return facts.fields.find(({ name }) => name === this.color.value);
  }

  recolored() {
    const { field, film, picture } = this;
    if (!picture) return;
    if (field) {
      const size = field.perFace ? film.faces : film.vertices;
      picture.table("values", film.fields[field.name].subarray(size * this.place, size * (this.place + 1)), 1, "one");
      picture.colors(facts.maps[field.map], field.categories);
    } else if (!picture.tables.colors || !picture.tables.values) {
      picture.table("values", new Uint8Array(1), 1, "one");
      picture.colors([[1, 1, 1], [1, 1, 1]], false);
    }
    if (this.explained !== field) this.explain(field);
    this.redraw();
  }

  /** The key to the colours. */
  explain(field) {
    this.explained = field;
    this.legend.replaceChildren();
    this.legend.hidden = !field;
    if (!field) return;
    const colors = facts.maps[field.map];
    const [low, high] = field.range;
    const title = make("b", {}, field.unit ? `${field.title}, ${field.unit}` : field.title);
    if (field.categories) {
      const patch = (k) => make("span", {}, make("i", { style: `background: ${css(colors[k === 0 ? 0 : 1 + ((k - 1) % 9)])}` }), String(k));
      this.legend.append(title, make("div", { class: "patches" }, Array.from({ length: Math.min(high, 24) }, (_, k) => patch(k + 1))));
      return;
    }
    const stops = colors.map(css).reverse().join(", ");
    const [under, over] = field.beyond.map((is, k) => (is ? (k === 0 ? "≤ " : "≥ ") : ""));
    this.legend.append(title, make("div", { class: "scale" },
      make("i", { style: `background: linear-gradient(${stops})` }),
      make("div", { class: "ticks" }, make("span", {}, over + short(high)), make("span", {}, short((low + high) / 2)), make("span", {}, under + short(low)))));
  }

  // How it is drawn.

  redraw() {
    if (!this.picture || this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.paint();
    });
  }

  resized() {
    const ratio = Math.min(devicePixelRatio || 1, 3);
    const { clientWidth, clientHeight } = this.canvas;
    const [width, height] = [Math.round(clientWidth * ratio), Math.round(clientHeight * ratio)];
    if (width > 0 && height > 0 && (width !== this.canvas.width || height !== this.canvas.height)) {
      [this.canvas.width, this.canvas.height] = [width, height];
      this.paint();
    }
  }

  paint(onPaper = false) {
    const { picture, surface, camera, canvas, boxes, film, field } = this;
    if (!picture) return;
    const seen = camera.see(this.place, canvas.width / canvas.height);
    // Places are relative to the middle of the film.
    const view = { ...seen, shift: matrix.apply(seen.turn, facts.camera.center).map((x, k) => x + seen.shift[k]) };
    const base = facts.look;
    const isDark = !onPaper && matchMedia("(prefers-color-scheme: dark)").matches && base.background[0][1] > 0.3;
    const lineColor = isDark ? DARK.line : base.lines.color;
    const through = boxes.through.checked;
    const own = base.opacity.some((x) => x < 1) || base.edgeOpacity < 1;
    const look = {
      ...base,
      lineColor,
      opacity: !through ? [1, 1] : own ? base.opacity : [0.32, 0.32],
      edgeOpacity: !through ? 1 : own ? base.edgeOpacity : 0.95,
      background: isDark ? [DARK.background, DARK.background] : base.background,
      rimDarkening: isDark && base.rimDarkening > 0 ? DARK.rimDarkening : base.rimDarkening,
      wireframe: boxes.mesh.checked ? base.wireframe || 0.35 : 0,
      painted: field ? (field.perFace ? 1 : 2) : 0,
      categories: Boolean(field && field.categories),
    };
    const { lines } = base;
    const kinds = [];
    if (boxes.outlines.checked) {
      if (!through || lines.silhouette > 0) kinds.push({ segments: surface.silhouettes(view), width: lines.silhouette || (own ? 0 : 2.2), color: lineColor, outline: true });
      kinds.push({ segments: surface.segments(surface.boundary), width: lines.boundary || 2.4, color: lineColor });
    }
    if (boxes.crossings.checked) kinds.push({ segments: surface.crossings, width: lines.intersection || 2.4, color: lineColor });
    if (boxes.rims.checked) {
      kinds.push({ segments: surface.segments(film.rims[this.place]), width: lines.rim || 8, color: lines.rimColor, raised: true });
      kinds.push({ segments: surface.points(film.pinchPoints[this.place]), width: lines.pinch || 16, color: lines.rimColor, raised: true });
    }
    if (boxes.pins?.checked) kinds.push({ segments: surface.points(film.pins), width: lines.pin || 10, color: isDark ? DARK.line : lines.pinColor, raised: true });
    picture.draw({ view, look, lines: kinds, faces: film.faces, ball: surface.ball, fine: !(this.slow > 2) || !(this.playing || this.dragging) });
    this.reset.disabled = !camera.isMoved;
    // Where pictures come slowly, those that move are coarser.
    const now = performance.now();
    const moves = this.playing || this.dragging;
    if (moves && this.lastMoved && now - this.lastMoved > 100) this.slow = (this.slow ?? 0) + 1;
    this.lastMoved = moves ? now : 0;
  }

  // How it plays.

  toggle() {
    if (this.playing) this.pause();
    else this.start();
  }

  start() {
    if (this.frames.length < 2) return;
    if (this.place === this.frames.length - 1) this.go(0);
    this.playing = true;
    this.play.textContent = "❚❚";
    this.play.setAttribute("aria-label", "Pause");
    const stride = facts.measured / this.frames.length;
    const since = performance.now();
    const from = this.place;
    const tick = (now) => {
      if (!this.playing) return;
      let place = from + Math.max(0, Math.floor(((now - since) / 1000) * this.rate / stride));
      const count = this.frames.length;
      if (place >= count) {
        if (!facts.loop) {
          this.go(count - 1);
          this.pause();
          return;
        }
        place %= count;
      }
      if (place !== this.place) this.go(place);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.play.textContent = "▶";
    this.play.setAttribute("aria-label", "Play");
    this.redraw();
  }

  home() {
    this.camera.reset();
    this.redraw();
  }

  fullscreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else this.element.requestFullscreen?.().catch(() => {});
  }

  // How it is turned.

  hands() {
    const { canvas, camera } = this;
    const fingers = new Map();
    const two = () => {
      const [a, b] = [...fingers.values()];
      return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(b.x - a.x, b.y - a.y), angle: Math.atan2(b.y - a.y, b.x - a.x) };
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      this.dragging = true;
    });
    canvas.addEventListener("pointermove", (event) => {
      const finger = fingers.get(event.pointerId);
      if (!finger) return;
      const height = canvas.clientHeight;
      const before = fingers.size === 2 ? two() : null;
      const [right, down] = [event.clientX - finger.x, event.clientY - finger.y];
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (before) {
        const now = two();
        camera.magnify(now.apart / Math.max(1, before.apart));
        camera.roll(before.angle - now.angle);
        camera.shift((now.x - before.x) / height, (before.y - now.y) / height);
      } else if (event.shiftKey || event.buttons === 4 || event.buttons === 2) camera.shift(right / height, -down / height);
      else camera.turn((4 * right) / height, (-4 * down) / height);
      this.redraw();
    });
    const let_go = (event) => {
      fingers.delete(event.pointerId);
      this.dragging = fingers.size > 0;
      this.redraw();
    };
    canvas.addEventListener("pointerup", let_go);
    canvas.addEventListener("pointercancel", let_go);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      // The page scrolls until the picture has been touched.
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      camera.magnify(Math.exp(-event.deltaY / 500));
      this.redraw();
    }, { passive: false });
    canvas.addEventListener("dblclick", () => this.home());
  }

  /** Keys that are pressed anywhere on the page but in a control that wants them. */
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target;
    if (target.matches?.("select, textarea, a, summary, input:not(#scrubber):not([type=checkbox])")) return;
    if (target.matches?.("button, input[type=checkbox], th") && (event.key === " " || event.key === "Enter")) return;
    const turn = 0.12;
    const flip = (name) => { const box = this.boxes[name]; if (box) { box.checked = !box.checked; this.redraw(); } };
    const actions = {
      " ": () => this.toggle(),
      ArrowLeft: () => (event.shiftKey ? this.camera.turn(-turn, 0) : this.step(-1)),
      ArrowRight: () => (event.shiftKey ? this.camera.turn(turn, 0) : this.step(1)),
      ArrowUp: event.shiftKey ? () => this.camera.turn(0, turn) : null,
      ArrowDown: event.shiftKey ? () => this.camera.turn(0, -turn) : null,
      PageUp: target === this.scrubber ? () => this.step(-10) : null,
      PageDown: target === this.scrubber ? () => this.step(10) : null,
      Home: () => { this.pause(); this.go(0); },
      End: () => { this.pause(); this.go(this.frames.length - 1); },
      "+": () => this.camera.magnify(1.15),
      "-": () => this.camera.magnify(1 / 1.15),
      r: () => this.home(), f: () => this.fullscreen(), t: () => flip("through"), o: () => flip("outlines"),
      i: () => flip("crossings"), u: () => flip("rims"), m: () => flip("mesh"),
      c: () => { this.color.selectedIndex = (this.color.selectedIndex + 1) % this.color.length; this.recolored(); },
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
    this.redraw();
  }

  step(by) {
    this.pause();
    this.go(this.place + by);
  }
}
