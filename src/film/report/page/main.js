// Puts the page together.

function header() {
  const { origin, curves } = facts;
  const { faces, genus, boundaries } = origin.mesh;
  const last = curves.l2.length - 1;
  const kind = [counted(faces, "face"), `genus ${genus}`, boundaries > 0 ? counted(boundaries, "boundary loop") : "no boundary"].join(", ");
  const [rims, pinches] = [curves.rims[last], curves.pinchPoints[last]];
  const folds = rims + pinches === 0 ? "without rims and pinch points" : `with ${counted(rims, "rim")} and ${counted(pinches, "pinch point")}`;
  const [error, largest] = [curves.l2[last], curves.max[last]].map((x) => percent(Number(x.toPrecision(2))));
  const summary = `${counted(facts.measured, "frame")} of a surface of ${kind}. ${facts.measured > 1 ? "In the last one lengths" : "Lengths"} are right to ` +
    `${error} (root mean square; the worst is off by ${largest}), ${folds}.`;
  return make("header", {}, make("p", { class: "kicker" }, "immerse · shape from metric"), make("h1", {}, origin.scene.replaceAll("_", " ")), make("p", { class: "lead" }, summary));
}

async function main() {
  const page = document.getElementById("page");
  page.append(header(), findings());
  const film = await unpack();
  const viewer = new Viewer(film);
  const found = events(film);
  viewer.mark(found);
  page.append(viewer.element);
  if (facts.measured > 1) page.append(new Curves(viewer).element);
  page.append(new Distribution(viewer).element, eventTable(found, viewer), classes(), unconverged(), scene(), versions());
  page.append(make("footer", {}, make("p", {},
    "Keys: Space plays, ← → go from frame to frame, Home and End to the ends, Shift with arrows turns, + − come closer and away, R resets the view, " +
    "C changes the colour, T see-through, O outlines, I self-intersections, U rims, M mesh, F the whole screen.")));
  addEventListener("keydown", (event) => viewer.key(event));
  openOnPaper();
  page.dataset.ready = "yes";
  globalThis.viewer = viewer; // for those who look behind the page
}

main().catch((error) => {
  console.error(error);
  document.getElementById("page").append(make("p", { class: "fault" }, `The film in this page cannot be read (${error.message}). Make the page again with immerse report.`));
});
