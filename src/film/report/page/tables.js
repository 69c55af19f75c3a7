// Tables of a film, and what is said in words.

/** What is wrong, first of all; or that all is well. */
function findings() {
  const { faults, checks } = facts.findings;
  const holding = checks.filter((check) => check.holds).length;
  const rows = checks.map((check) => ({ mark: check.holds ? null : "broken", cells: [check.name, check.limit, check.value, check.holds ? "yes" : "NO"] }));
  const list = checks.length > 0
    ? make("details", { open: holding < checks.length }, make("summary", {}, `${holding} of ${counted(checks.length, "check")} ${holding === 1 ? "holds" : "hold"}`),
      table(["check", "limit", "value", "holds"], rows, { sorts: false }))
    : make("p", { class: "note" }, "The scene states no checks.");
  const missing = facts.origin.frames - facts.measured;
  const all = missing > 0 ? [`${counted(missing, "frame")} of ${facts.origin.frames} are not computed, or damaged: the page ends with frame ${facts.measured}.`, ...faults] : faults;
  const isBroken = holding < checks.length || missing > 0;
  const words = all.length > 0
    ? make("div", { class: isBroken ? "fault" : "fault mild" }, make("h2", {}, isBroken ? "Not all is well" : "Worth knowing"), make("ul", {}, all.map((fault) => make("li", {}, marked(fault)))))
    : make("p", { class: "well" }, checks.length > 0 ? "All that the scene asks for holds." : "Nothing is wrong that the program would know of.");
  return make("section", { class: "findings", "aria-label": "Findings" }, words, list);
}

/** Generators of the surface, and the class of what was found on them. */
function classes() {
  const { generators } = facts;
  const { asked, class: found } = facts.curves;
  const section = make("section", {}, make("h2", {}, "Generators and class"));
  if (generators.length === 0) {
    section.append(make("p", {}, "No loop on this surface but those that contract: it has no generators, and there is one class."));
    return section;
  }
  const figure = (digit) => (digit == null ? "–" : digit === "1" ? "1 (figure 8)" : "0 (figure 0)");
  section.append(table(["generator", "length", "faces", "asked for", "found"], generators.map((g, k) => ({
    mark: g.asked != null && g.found != null && g.asked !== g.found ? "broken" : null,
    cells: [[k + 1, String(k + 1)], [g.length, short(g.length)], [g.faces, String(g.faces)], figure(g.asked), figure(g.found)],
  }))));
  const last = found.length - 1;
  const gallery = asked.some((a) => a !== asked[last]);
  if (gallery) {
    section.append(table(["frame", "asked for", "found", "length error"], found.map((f, k) => ({
      mark: f === asked[k] ? null : "broken",
      cells: [[k + 1, String(k + 1)], asked[k] || "–", f || "–", [facts.curves.l2[k], percent(facts.curves.l2[k])]],
    }))));
  }
  const wrong = found.filter((f, k) => f !== asked[k] && asked[k]).length;
  const words = wrong === 0
    ? `Class ${found[last] || "–"} in the last frame, and in each frame the one that was asked for.`
    : `Class ${found[last] || "–"} in the last frame; ${counted(wrong, "frame")} of ${found.length} ${wrong === 1 ? "has" : "have"} not the one that was asked for (a pinched surface, —, has none).`;
  section.append(make("p", { class: "note" }, `Lengths are measured in the first frame from face to face. ${words}`));
  return section;
}

/** What did not converge, and why. */
function unconverged() {
  const list = facts.unconverged;
  const section = make("section", {}, make("h2", {}, "What did not converge"));
  if (list.length === 0) {
    section.append(make("p", {}, "Every frame that was to settle has settled."));
    return section;
  }
  const shown = list.slice(0, 200);
  section.append(
    make("p", {}, `${counted(list.length, "frame")} of ${facts.measured} ran into the limit of steps before the frames of faces stood still. What may be the cause is said at the top of this page; a frame with rims has folds that did not open.`),
    table(["frame", "length error", "largest", "steps until then", "rims", "pinch points", "drawn anew"], shown.map((row) => [
      [row.frame, String(row.frame)], [row.error, percent(row.error)], [row.max, percent(row.max)], [row.steps, String(row.steps)],
      [row.rims, String(row.rims)], [row.pinchPoints, String(row.pinchPoints)], [row.restarts, String(row.restarts)],
    ])));
  if (list.length > shown.length) section.append(make("p", { class: "note" }, `${list.length - shown.length} more are in the reports beside the frames.`));
  return section;
}

/** Where the surface folds, unfolds, and begins or ends to pass through itself. */
function events(film) {
  const list = [];
  const c = facts.curves;
  facts.frames.forEach((number, place) => {
    const crossing = film.crossings[place].length > 0;
    const before = place > 0 && film.crossings[place - 1].length > 0;
    // Of all frames since the one before that the page has.
    const since = place > 0 ? facts.frames[place - 1] : number - 1;
    const sum = (values) => values.slice(since, number).reduce((total, x) => total + x, 0);
    const [born, died, moved] = place > 0 ? [sum(c.born), sum(c.died), sum(c.moved)] : [0, 0, 0];
    const words = [];
    if (born) words.push(`${counted(born, "rim")} born`);
    if (died) words.push(`${counted(died, "rim")} died`);
    if (moved) words.push(`${counted(moved, "rim")} moved`);
    if (place > 0 && crossing && !before) words.push("the surface begins to pass through itself");
    if (place > 0 && !crossing && before) words.push("the surface no longer passes through itself");
    if (words.length > 0) list.push({ place, number, words: words.join(", "), kind: born ? "born" : died || moved ? "died" : "crossing" });
  });
  return list;
}

function eventTable(list, viewer) {
  const section = make("section", {}, make("h2", {}, "Fold events"));
  if (list.length === 0) {
    section.append(make("p", {}, "No rim appears or vanishes, and the surface neither begins nor ends to pass through itself."));
    return section;
  }
  const row = ({ place, number, words }) => [
    make("button", { type: "button", class: "link", onclick: () => { viewer.pause(); viewer.go(place); viewer.canvas.scrollIntoView({ block: "nearest", behavior: "smooth" }); } }, `frame ${number}`), words,
  ];
  const all = table(["when", "what"], list.map(row), { sorts: false });
  section.append(list.length > 8 ? make("details", {}, make("summary", {}, counted(list.length, "frame with an event", "frames with events")), all) : all);
  return section;
}

/** The scene, and the command that makes the film of it. */
function scene() {
  const { command } = facts.findings;
  const { text, origin } = facts;
  const section = make("section", { class: "scene" }, make("h2", {}, "The scene"),
    make("p", {}, "This command makes the film again, with the same bits on any number of threads, from the scene below in a file of that name:"),
    make("div", { class: "command" }, make("code", {}, command), copy(command)));
  if (text) section.append(make("details", {}, make("summary", {}, `${origin.scene}.toml`, " ", copy(text)), make("pre", {}, make("code", {}, text))));
  else section.append(make("p", { class: "note" }, "The film was made by a program, not from a scene file."));
  return section;
}

function versions() {
  const { origin } = facts;
  const { vertices, edges, faces, genus, boundaries } = origin.mesh;
  return make("section", { class: "versions" }, make("h2", {}, "What made it"), table(["", ""], [
    ["frames computed by", origin.program], ["page made by", origin.page], ["files", `version ${origin.format}`],
    ["mesh", `${counted(vertices, "vertex", "vertices")}, ${counted(edges, "edge")}, ${counted(faces, "face")}, genus ${genus}, ${counted(boundaries, "boundary loop")}`],
    ["SHA-256 of the mesh", origin.meshKey], ["key of all frames", origin.filmKey],
  ], { sorts: false }));
}
