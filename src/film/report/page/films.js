// The page of several films: what they are, a picture of each, and a table.

const COLUMNS = [
  ["length error", (last) => [last.l2_length_error, percent(last.l2_length_error)]],
  ["95 %", (last) => [last.p95_length_error, percent(last.p95_length_error)]],
  ["largest", (last) => [last.max_length_error, percent(last.max_length_error)]],
  ["rims", (last) => [last.rims, String(last.rims)]],
  ["pinch points", (last) => [last.pinch_points, String(last.pinch_points)]],
  ["class", (last) => last.spin_class || "–"],
  ["energy", (last) => [last.energy, short(last.energy)]],
  ["bending error", (last) => (last.bending_error ? [last.bending_error.rms_degrees, `${short(last.bending_error.rms_degrees)}°`] : "–")],
  ["steps", (last) => [last.steps, String(last.steps)]],
  ["drawn anew", (last) => [last.restarts, String(last.restarts)]],
  ["settled", (last) => (last.converged ? "yes" : "NO")],
];

const isBroken = (run) => run.checks === "NO" || !run.last;
const label = (run) => run.values.map((value, k) => `${facts.keys[k]} = ${value}`).join(", ") || run.name;

function header() {
  const errors = facts.runs.filter((run) => run.last).map((run) => run.last.l2_length_error);
  const varied = facts.keys.map((key, k) => `${key} = ${[...new Set(facts.runs.map((run) => run.values[k]))].join(", ")}`);
  const rounded = (x) => percent(Number(x.toPrecision(2)));
  const [least, most] = [Math.min(...errors), Math.max(...errors)];
  const right = errors.length > 0 ? ` Lengths are right to ${least === most ? rounded(least) : `between ${rounded(least)} and ${rounded(most)}`} (root mean square, in the last frames).` : "";
  const lead = `${counted(facts.runs.length, "film")} of one scene${varied.length > 0 ? `: every combination of ${varied.join("; ")}` : ""}.${right}`;
  return make("header", {}, make("p", { class: "kicker" }, "immerse · shape from metric"), make("h1", {}, facts.scene.replaceAll("_", " ")),
    make("p", { class: "lead" }, lead), facts.common.length > 0 ? make("p", { class: "note" }, `In all of them ${facts.common.join(", ")}.`) : null);
}

function findings() {
  const [missing, broken] = [facts.runs.filter((run) => !run.last), facts.runs.filter((run) => run.last && run.checks === "NO")];
  const asked = facts.runs.some((run) => run.checks !== "-");
  const names = (runs) => runs.slice(0, 24).map((run) => make("li", {}, leading(run, label(run))))
    .concat(runs.length > 24 ? [make("li", {}, `and ${runs.length - 24} more, which the table marks`)] : []);
  const paragraph = (runs, words) => (runs.length > 0 ? [make("p", {}, words), make("ul", {}, names(runs))] : []);
  const of = (runs) => `${runs.length} of ${counted(facts.runs.length, "film")}`;
  const words = missing.length + broken.length > 0
    ? make("div", { class: "fault" }, make("h2", {}, "Not all is well"),
      paragraph(missing, `${of(missing)} ${missing.length === 1 ? "is" : "are"} not there; a .log beside ${missing.length === 1 ? "its" : "their"} folder says why.`),
      paragraph(broken, `${of(broken)} ${broken.length === 1 ? "does" : "do"} not hold to the checks of the scene; ${broken.length === 1 ? "its page says" : "their pages say"} which.`))
    : make("p", { class: "well" }, asked ? "All that the scene asks for holds in every film." : "Every film is there; the scene states no checks.");
  return make("section", { class: "findings", "aria-label": "Findings" }, words);
}

/** What leads to the page of a run, if it has one. */
const leading = (run, ...children) => (run.page ? make("a", { href: run.page }, children) : make("span", {}, children));

function pictures() {
  const shown = facts.runs.filter((run) => run.picture);
  const caption = (run) => make("figcaption", {}, make("b", {}, label(run)), make("br"), `length error ${percent(Number(run.last.l2_length_error.toPrecision(2)))}`);
  return make("section", { class: "sheet" }, shown.map((run) => make("figure", {}, leading(run, make("img", { src: run.picture, alt: label(run), loading: "lazy" })), caption(run))));
}

function tableOfRuns() {
  // What none of the films has is left out.
  const has = { "bending error": (last) => last.bending_error, "drawn anew": (last) => last.restarts > 0, class: (last) => last.spin_class };
  const shows = COLUMNS.filter(([name]) => !has[name] || facts.runs.some((run) => run.last && has[name](run.last)));
  const isNumber = (text) => text !== "" && !Number.isNaN(Number(text)) && !/^0\d/.test(text);
  const numeric = facts.keys.map((_, k) => facts.runs.every((run) => isNumber(run.values[k])));
  const rows = facts.runs.map((run) => ({
    mark: isBroken(run) ? "broken" : null,
    cells: [
      [run.name, leading(run, run.picture ? make("img", { class: "small", src: run.picture, alt: "" }) : "–")],
      ...run.values.map((text, k) => (numeric[k] ? [Number(text), text] : text)),
      run.checks === "-" ? "–" : run.checks,
      ...shows.map(([, cell]) => (run.last ? cell(run.last) : "–")),
    ],
  }));
  const all = table(["film", ...facts.keys, "checks", ...shows.map(([name]) => name)], rows);
  return make("section", { class: "runs" }, make("h2", {}, "Last frames"), make("p", { class: "note" }, "A heading sorts the table. The same is in sweep.csv, with seconds, for other programs."), all);
}

function command() {
  return make("section", { class: "scene" }, make("h2", {}, "Again"), make("p", {}, "This command makes what is not there, and this page, with the same films on any number of threads:"),
    make("div", { class: "command" }, make("code", {}, facts.command), copy(facts.command)), make("p", { class: "note" }, `Page made by ${facts.program}.`));
}

document.getElementById("page").append(header(), findings(), pictures(), tableOfRuns(), command());
openOnPaper();
document.getElementById("page").dataset.ready = "yes";
