// A frame as it is drawn: places, normals, and the edges that are lines.

class Surface {
  constructor(film) {
    this.film = film;
    const { vertices, faces, triangles } = film;
    this.places = new Float32Array(4 * vertices);
    this.normals = new Float32Array(4 * vertices);
    this.facing = new Float32Array(3 * faces);
    this.corners = new Uint32Array(4 * faces);
    for (let f = 0; f < faces; f++) this.corners.set(triangles.subarray(3 * f, 3 * f + 3), 4 * f);
    this.sky = new Uint8Array(2 * vertices);
    this.findEdges();
  }

  /** Ends of each edge, and the one or two faces beside it. */
  findEdges() {
    const { vertices, faces, triangles } = this.film;
    const known = new Map();
    const edges = [];
    for (let f = 0; f < faces; f++)
      for (let k = 0; k < 3; k++) {
        const a = triangles[3 * f + k], b = triangles[3 * f + ((k + 1) % 3)];
        const key = Math.min(a, b) * vertices + Math.max(a, b);
        const edge = known.get(key);
        if (edge === undefined) known.set(key, edges.push([a, b, f, -1]) - 1);
        else edges[edge][3] = f;
      }
    this.edges = new Int32Array(edges.flat());
    this.boundary = edges.filter((edge) => edge[3] < 0).flatMap(([a, b]) => [a, b]);
  }

  /** Goes to a frame; places are relative to the middle of the film. */
  show(frame) {
    const { film, places, normals, sky } = this;
    const { vertices } = film;
    const { origin, step } = facts.grid;
    const start = origin.map((x, k) => x - facts.camera.center[k]);
    const from = 3 * vertices * frame;
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let axis = 0; axis < 3; axis++)
      for (let v = 0; v < vertices; v++) {
        const x = (places[4 * v + axis] = start[axis] + step * film.places[from + axis * vertices + v]);
        low[axis] = Math.min(low[axis], x);
        high[axis] = Math.max(high[axis], x);
      }
    const middle = low.map((x, k) => (x + high[k]) / 2);
    this.ball = { middle, radius: Math.hypot(...low.map((x, k) => high[k] - x)) / 2 || 1 };
    normals.fill(0);
    for (let f = 0; f < film.faces; f++) this.addNormal(f);
    for (let v = 0; v < vertices; v++) {
      const size = Math.hypot(normals[4 * v], normals[4 * v + 1], normals[4 * v + 2]) || 1;
      for (let k = 0; k < 3; k++) normals[4 * v + k] /= size;
      // Shares of 63 as bytes.
      for (let side = 0; side < 2; side++) sky[2 * v + side] = Math.round((255 / 63) * film.sky[vertices * (2 * frame + side) + v]);
    }
    this.crossings = Float32Array.from(film.crossings[frame], (x, k) => start[k % 3] + step * facts.grid.curveSteps * x);
    this.frame = frame;
  }

  /** The normal of a face, and its share of those of its corners, by their angles. */
  addNormal(f) {
    const { places, normals, facing, corners } = this;
    const at = [0, 1, 2].map((k) => 4 * corners[4 * f + k]);
    const side = (from, to) => [places[to] - places[from], places[to + 1] - places[from + 1], places[to + 2] - places[from + 2]];
    const sides = [side(at[0], at[1]), side(at[1], at[2]), side(at[2], at[0])];
    const [[ax, ay, az], , [cx, cy, cz]] = sides;
    let n = [az * cy - ay * cz, ax * cz - az * cx, ay * cx - ax * cy];
    const size = Math.hypot(...n) || 1;
    n = n.map((x) => x / size);
    facing.set(n, 3 * f);
    const lengths = sides.map((s) => Math.hypot(...s) || 1);
    for (let k = 0; k < 3; k++) {
      const a = sides[k], b = sides[(k + 2) % 3];
      const cosine = -(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (lengths[k] * lengths[(k + 2) % 3]);
      const angle = Math.acos(Math.min(1, Math.max(-1, cosine)));
      for (let c = 0; c < 3; c++) normals[at[k] + c] += n[c] * angle;
    }
  }

  /** Edges given by pairs of vertices, as ends of segments. */
  segments(pairs) {
    const { places } = this;
    const ends = new Float32Array(3 * pairs.length);
    for (let k = 0; k < pairs.length; k++) for (let c = 0; c < 3; c++) ends[3 * k + c] = places[4 * pairs[k] + c];
    return ends;
  }

  /** Points, as segments without length. */
  points(vertices) {
    return this.segments(Array.from(vertices, (v) => [v, v]).flat());
  }

  /** Edges between a face whose front is seen and one whose back is. */
  silhouettes(view) {
    const { edges, facing, places, corners, film } = this;
    // The eye, or the direction to it, in the space of the film.
    const back = (v) => [0, 1, 2].map((column) => view.turn[3 * column] * v[0] + view.turn[3 * column + 1] * v[1] + view.turn[3 * column + 2] * v[2]);
    const eye = view.perspective ? back(view.shift.map((x) => -x)) : back([0, 0, 1]);
    const shows = new Uint8Array(film.faces);
    for (let f = 0; f < film.faces; f++) {
      const at = 4 * corners[4 * f];
      let sum = 0;
      for (let c = 0; c < 3; c++) sum += facing[3 * f + c] * (view.perspective ? eye[c] - places[at + c] : eye[c]);
      shows[f] = sum > 0 ? 1 : 0;
    }
    const pairs = [];
    for (let k = 0; k < edges.length; k += 4)
      if (edges[k + 3] >= 0 && shows[edges[k + 2]] !== shows[edges[k + 3]]) pairs.push(edges[k], edges[k + 1]);
    return this.segments(pairs);
  }
}
