// FOLD files of pieces: what Flat-Folder and Origami Simulator ask for, and the faces and the flat
// state by functions of the npm package "fold", which must agree with the file's and the master's.
//
// Usage: node check_pieces.mjs MASTER.fold PIECE.fold...
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const require = createRequire(process.env.NODE_TOOLS + "/");
const FOLD = require("fold");
const TOLERANCE_MM = 1e-6;

const faults = [];
const ensure = (holds, fault) => holds || faults.push(fault);
const read = (path) => JSON.parse(readFileSync(path, "utf8"));
const distance = (a, b) => Math.hypot(...a.map((x, k) => x - (b[k] ?? 0)));
/** A face from its least vertex on, as a text. */
const cycle = (face) => {
  const first = face.indexOf(Math.min(...face));
  return [...face.slice(first), ...face.slice(0, first)].join(" ");
};

/** One frame, one connected sheet, plain assignments, faces whose edges are all there. */
function checkReadersRules(piece, name) {
  const { vertices_coords: points, edges_vertices: edges, faces_vertices: faces } = piece;
  ensure(!("file_frames" in piece), `${name}: more than one frame`);
  ensure(points.every((p) => p.length === 3 && p[2] === 0), `${name}: not in the plane z = 0`);
  const { edges_assignment: kinds, edges_foldAngle: angles } = piece;
  ensure(kinds.length === edges.length && angles.length === edges.length, `${name}: lengths of lists`);
  kinds.forEach((kind, e) => {
    const expected = { M: -180, V: 180, F: 0, B: 0 }[kind];
    ensure(expected === angles[e], `${name}: edge ${e} is ${kind} and folded by ${angles[e]}`);
  });
  const known = new Set(edges.flatMap(([a, b]) => [`${a} ${b}`, `${b} ${a}`]));
  const parent = points.map((_, v) => v);
  const root = (v) => (parent[v] === v ? v : (parent[v] = root(parent[v])));
  for (const face of faces) {
    face.forEach((v, k) => {
      const next = face[(k + 1) % face.length];
      ensure(known.has(`${v} ${next}`), `${name}: face edge ${v} ${next} is no edge`);
      parent[root(v)] = root(next);
    });
    const corners = face.map((v) => points[v].slice(0, 2));
    ensure(FOLD.geom.polygonOrientation(corners) > 0, `${name}: face ${cycle(face)} is clockwise`);
  }
  ensure(new Set(points.map((_, v) => root(v))).size === 1, `${name}: not one connected sheet`);
}

/** Whether two edges leave a corner in one direction: a slit whose sides touch. */
function hasTouchingSlit(piece) {
  const { vertices_coords: points, edges_vertices: edges } = piece;
  const leaving = points.map(() => []);
  for (const [a, b] of edges.flatMap(([a, b]) => [[a, b], [b, a]])) {
    const step = [0, 1].map((k) => points[b][k] - points[a][k]);
    leaving[a].push(step.map((x) => x / Math.hypot(...step)));
  }
  const isSame = (p, q) => distance(p, q) < 1e-6;
  return leaving.some((steps) => steps.some((p, k) => steps.slice(k + 1).some((q) => isSame(p, q))));
}

/** Faces found from the edges alone are those of the file, where the edges tell. */
function checkFaces(piece, name) {
  if (hasTouchingSlit(piece)) return;
  const graph = {
    vertices_coords: piece.vertices_coords.map((p) => p.slice(0, 2)),
    edges_vertices: piece.edges_vertices.map((e) => [...e]),
  };
  FOLD.convert.edges_vertices_to_faces_vertices_edges(graph);
  const [found, given] = [graph, piece].map((fold) => fold.faces_vertices.map(cycle).sort());
  ensure(JSON.stringify(found) === JSON.stringify(given), `${name}: the faces are not those between the edges`);
}

/** Folded along its mountains by the package, the piece is as flat as in the master. */
function checkFlat(piece, flat, name) {
  const keep = piece.edges_assignment.map((kind) => kind !== "F");
  const graph = {
    vertices_coords: piece.vertices_coords.map((p) => p.slice(0, 2)),
    edges_vertices: piece.edges_vertices.filter((_, e) => keep[e]),
  };
  FOLD.convert.edges_vertices_to_faces_vertices_edges(graph);
  const error = FOLD.convert.flatFoldedGeometry(graph);
  ensure(error < TOLERANCE_MM, `${name}: does not close by ${error} mm`);
  const folded = graph.vertices_flatFoldCoords;
  const used = folded.map((p, v) => (p ? v : -1)).filter((v) => v >= 0);
  ensure(used.length > 3, `${name}: nothing is folded`);
  for (const v of used.slice(1)) {
    for (const w of [used[0], used[Math.floor(used.length / 2)]]) {
      const wrong = Math.abs(distance(folded[v], folded[w]) - distance(flat[v], flat[w]));
      ensure(wrong < 1e-4, `${name}: vertices ${v} and ${w} are ${wrong} mm off in the flat state`);
    }
  }
}

const [masterPath, ...given] = process.argv.slice(2);
const master = read(masterPath);
// Files come by their names; the master has the pieces in the order of its components.
const components = [...new Set(master["faces_tatamu:component"])];
const place = (path) => components.indexOf(read(path).frame_title.replace(/ \d+\/\d+$/, ""));
const paths = given.map((path) => [place(path), path]).sort(([a], [b]) => a - b).map(([, path]) => path);
const flat = master.file_frames.find((frame) => frame.frame_title === "flat").vertices_coords;
let first = 0;
for (const path of paths) {
  const piece = read(path);
  const name = piece.frame_title;
  const count = piece.vertices_coords.length;
  checkReadersRules(piece, name);
  checkFaces(piece, name);
  checkFlat(piece, flat.slice(first, first + count), name);
  first += count;
}
ensure(first === flat.length, `${first} vertices in the pieces, ${flat.length} in the master`);
faults.slice(0, 20).forEach((fault) => console.log(fault));
if (faults.length) {
  console.log(`${faults.length} faults`);
  process.exit(1);
}
console.log(`${paths.length} pieces: all right`);
