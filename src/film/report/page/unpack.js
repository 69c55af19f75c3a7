// From the texts in the page to arrays.

/** The bytes of a stream. */
async function bytesOf(name) {
  const element = document.getElementById(`data-${name}`);
  const packed = Uint8Array.from(atob(element.textContent), (c) => c.charCodeAt(0));
  element.remove(); // its text is not needed again
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Numbers of four bytes, of which all first bytes come first. */
async function numbersOf(name) {
  const bytes = await bytesOf(name);
  const count = bytes.length / 4;
  const numbers = new Uint32Array(count);
  for (let k = 0; k < count; k++)
    numbers[k] = (bytes[k] | (bytes[count + k] << 8) | (bytes[2 * count + k] << 16) | (bytes[3 * count + k] << 24)) >>> 0;
  return numbers;
}

/** Lists of different lengths, one a frame: their lengths come first. */
async function listsOf(name, frames) {
  const numbers = await numbersOf(name);
  let start = frames;
  return Array.from({ length: frames }, (_, k) => numbers.subarray(start, (start += numbers[k])));
}

/** The reverse of folding signed differences into small numbers. */
function unfolded(x) {
  return (x >>> 1) ^ -(x & 1);
}

/** For each vertex those of its neighbours that come before it, breadth first; with where each list begins. */
function earlierNeighbours(vertices, triangles) {
  const all = Array.from({ length: vertices }, () => []);
  for (let f = 0; f < triangles.length; f += 3)
    for (let k = 0; k < 3; k++) all[triangles[f + k]].push(triangles[f + ((k + 1) % 3)], triangles[f + ((k + 2) % 3)]);
  const rank = new Int32Array(vertices).fill(-1);
  const queue = [];
  let next = 0;
  const visit = (v) => { if (rank[v] < 0) rank[v] = queue.push(v) - 1; };
  for (let first = 0; first < vertices; first++)
    for (visit(first); next < queue.length; next++) all[queue[next]].forEach(visit);
  const lists = all.map((list, v) => list.filter((u) => rank[u] < rank[v]));
  return { order: queue, lists };
}

/**
 * Places of all vertices on the grid, frame by frame: x of all, then y, then z. A frame is guessed from those before it, and
 * each vertex is as far from its guess as its neighbours are from theirs.
 */
function placesOf(bytes, vertices, triangles, frames) {
  const size = 3 * vertices;
  const all = new Uint16Array(size * frames);
  const far = new Int16Array(vertices);
  const { order, lists } = earlierNeighbours(vertices, triangles);
  for (let frame = 0; frame < frames; frame++) {
    const read = frame * (2 * size + 1);
    const guess = bytes[read];
    for (let axis = 0; axis < 3; axis++) {
      const start = frame * size + axis * vertices;
      for (const v of order) {
        const k = axis * vertices + v;
        const list = lists[v];
        let sum = 0;
        for (let n = 0; n < list.length; n++) sum += far[list[n]];
        const mean = list.length > 0 ? Math.trunc(sum / list.length) : 0;
        far[v] = mean + unfolded(bytes[read + 1 + k] | (bytes[read + 1 + size + k] << 8));
        const at = start + v;
        const guessed = guess === 0 ? 32768 : guess === 1 ? all[at - size] : 2 * all[at - size] - all[at - 2 * size];
        all[at] = guessed + far[v];
      }
    }
  }
  return all;
}

/** Bytes of which each frame has as many, told from those of the frame before. */
function sharesOf(bytes, size) {
  for (let k = size; k < bytes.length; k++) bytes[k] += bytes[k - size];
  return bytes;
}

/** Curves, frame by frame, as pairs of points that follow each other, each with x, y, z on the grid. */
async function curvesOf(frames) {
  const counts = await numbersOf("crossing-counts");
  const bytes = await bytesOf("crossings");
  const points = bytes.length / 6;
  const all = new Uint16Array(3 * points);
  let before = 0;
  for (let k = 0; k < 3 * points; k++) before = all[k] = before + unfolded(bytes[k] | (bytes[3 * points + k] << 8));
  let curve = frames;
  let point = 0;
  return Array.from({ length: frames }, (_, frame) => {
    const segments = [];
    for (let n = 0; n < counts[frame]; n++) {
      const last = point + counts[curve++] - 1;
      for (; point < last; point++)
        for (const end of [point, point + 1]) segments.push(all[end], all[points + end], all[2 * points + end]);
      point++;
    }
    return new Uint16Array(segments);
  });
}

/** Everything that changes from frame to frame. */
async function unpack() {
  const frames = facts.frames.length;
  const triangles = await numbersOf("triangles");
  const { vertices, faces } = facts.origin.mesh;
  const fields = {};
  for (const { name, perFace } of facts.fields) fields[name] = sharesOf(await bytesOf(name), perFace ? faces : vertices);
  return {
    vertices,
    faces,
    triangles,
    fields,
    pins: await numbersOf("pins"),
    places: placesOf(await bytesOf("positions"), vertices, triangles, frames),
    sky: sharesOf(await bytesOf("sky"), 2 * vertices),
    crossings: await curvesOf(frames),
    rims: await listsOf("rims", frames),
    pinchPoints: await listsOf("pinch-points", frames),
    histogram: await numbersOf("histogram"),
  };
}
