// The library of the format: counts, assignments, and the mesh made of its edges.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import assert from "node:assert";

const FOLD = createRequire(process.argv[3] + "/")("fold");
for (const name of ["closed", "parts"]) {
  const fold = JSON.parse(readFileSync(`${process.argv[2]}/${name}/export/film.fold`, "utf8"));
  const { filter, convert } = FOLD;
  assert.equal(filter.numVertices(fold), fold.vertices_coords.length);
  assert.equal(filter.numEdges(fold), fold.edges_vertices.length);
  assert.equal(filter.numFaces(fold), fold.faces_vertices.length);
  const boundary = filter.boundaryEdges(fold).length;
  assert.equal(boundary, name === "parts" ? 4 : 0);
  const mountains = filter.mountainEdges(fold).length, valleys = filter.valleyEdges(fold).length;
  const flat = filter.flatEdges(fold).length;
  assert.equal(mountains + valleys + flat + boundary, fold.edges_vertices.length);
  assert.ok(name !== "closed" || mountains > 0.9 * fold.edges_vertices.length, "a convex surface has mountains");
  const edges = convert.faces_vertices_to_edges({ faces_vertices: fold.faces_vertices }).edges_vertices;
  assert.equal(edges.length, fold.edges_vertices.length);
  console.log(`fold (npm): ${name}: ${mountains} mountains, ${valleys} valleys, ${boundary} at the boundary`);
}
