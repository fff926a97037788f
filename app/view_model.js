"use strict";
// What is to be seen, as arrays. Nothing here touches the page, but for its data.
const data = JSON.parse(document.getElementById("data").textContent);
function bytesOf(text) {
  const characters = atob(text), bytes = new Uint8Array(characters.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = characters.charCodeAt(k);
  return bytes.buffer;
}
const numbers = ({bytes, data}) => bytes === 4 ? new Uint32Array(bytesOf(data)) : new Uint16Array(bytesOf(data));
const unpacked = items => Object.fromEntries(Object.entries(items).map(([key, item]) => [key, item.data === undefined ? item : numbers(item)]));
const points = new Float32Array(bytesOf(data.arrays.points));
const triangles = unpacked(data.arrays.triangles), elements = unpacked(data.arrays.elements), outline = unpacked(data.arrays.outline);
delete data.arrays;
const solid = data.dimension === 3;
const half = [0, 1, 2].map(k => (data.upper[k] - data.lower[k]) / 2), middle = [0, 1, 2].map(k => (data.upper[k] + data.lower[k]) / 2);
const radius = Math.hypot(...half) || 1;

// What the controls say. `cut`: {normal, place}; what is beyond it is not seen. `under`: degrees, or null for all.
const state = {colours: "group", hidden: new Set(), apart: 0, cut: null, under: null, marks: true};

const rgb = text => [1, 3, 5].map(at => parseInt(text.slice(at, at + 2), 16));
const colours = {group: data.groups.map(({colour}) => rgb(colour)), piece: data.pieces.map(({colour}) => rgb(colour)),
  material: data.materials.map(({colour}) => rgb(colour)), angle: data.angleColours.map(rgb)};
const inside = [214, 208, 196];
const colourOfAngle = angle => colours.angle[Math.min(70, Math.floor(angle / 100))];
// Groups do not tell elements under an angle apart.
const colourKind = () => state.colours === "group" && state.under !== null ? "angle" : state.colours;
function colourOf(items, k) {
  const kind = colourKind();
  if (kind === "piece") return colours.piece[items.pieces[k]];
  if (kind === "material") return colours.material[items.materials[k]];
  if (kind === "angle") return colourOfAngle(items.angles[k]);
  return items.groups ? colours.group[items.groups[k]] : inside;
}
const isUnder = (items, k) => state.under === null || items.angles[k] < 100 * state.under;

// Triangles that become arrays: places, colours, and of each corner how far it is from the three edges; an edge that is not
// to be drawn is far from all.
class soup {
  constructor(most = 64) {
    this.places = new Float32Array(9 * most);
    this.colours = new Uint8Array(9 * most);
    this.corners = new Uint8Array(9 * most);
    this.count = 0;
  }
  add(a, b, c, colour, without = -1) {
    if (9 * (this.count + 1) > this.places.length) this.grow();
    const at = 9 * this.count++;
    this.set(at, 0, a, colour, without);
    this.set(at + 3, 1, b, colour, without);
    this.set(at + 6, 2, c, colour, without);
  }
  set(at, corner, p, colour, without) {
    for (let k = 0; k < 3; ++k) {
      this.places[at + k] = p[k];
      this.colours[at + k] = colour[k];
      this.corners[at + k] = corner === k || k === without ? 255 : 0;
    }
  }
  grow() {
    for (const key of ["places", "colours", "corners"]) {
      const old = this[key];
      this[key] = new old.constructor(2 * old.length);
      this[key].set(old);
    }
  }
}
// The corners of a triangle, an element or an edge. They are the same four each time, since there are millions.
const places = [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]];
function cornersOf(items, n, k) {
  const centre = data.centres[items.pieces[k]];
  for (let i = 0; i < n; ++i) {
    const at = 3 * items.vertices[n * k + i], place = places[i];
    for (let c = 0; c < 3; ++c) place[c] = points[at + c] + state.apart * centre[c];
  }
  return places;
}
function addTriangle(shown, k, colour) {
  const [a, b, c] = cornersOf(triangles, 3, k);
  shown.add(a, b, c, colour);
}

// Sides, or elements where only those under an angle are asked for. Sides between pieces are hidden unless something is open.
const sides = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
function shownTriangles() {
  const isOpen = state.hidden.size > 0 || state.apart > 0 || state.cut, count = isOpen ? triangles.pieces.length : triangles.outer;
  const ofElements = state.under !== null && solid, shown = new soup(ofElements ? 64 : count || 1);
  for (let k = 0; ofElements && k < elements.pieces.length; ++k) {
    if (!isUnder(elements, k)) continue;
    const p = cornersOf(elements, 4, k), colour = colourOf(elements, k);
    for (const [a, b, c] of sides) shown.add(p[a], p[b], p[c], colour);
  }
  for (let k = 0; !ofElements && k < count; ++k)
    if (!state.hidden.has(triangles.groups[k]) && isUnder(triangles, k)) addTriangle(shown, k, colourOf(triangles, k));
  return shown;
}
// The outer sides as they are around elements under an angle.
function ghost() {
  const shown = new soup();
  for (let k = 0; state.under !== null && k < triangles.outer; ++k)
    if (!state.hidden.has(triangles.groups[k])) addTriangle(shown, k, [130, 140, 160]);
  return shown;
}
// Where the plane cuts the elements: triangles, or quadrangles without their diagonal.
function section() {
  const shown = new soup();
  if (!state.cut || !solid) return shown;
  const {normal, place} = state.cut, above = [0, 0, 0, 0];
  for (let k = 0; k < elements.pieces.length; ++k) {
    if (!isUnder(elements, k)) continue;
    const p = cornersOf(elements, 4, k);
    let count = 0;
    for (let i = 0; i < 4; ++i) {
      above[i] = normal[0] * p[i][0] + normal[1] * p[i][1] + normal[2] * p[i][2] - place;
      count += above[i] > 0;
    }
    if (count % 4 === 0) continue;
    const upper = [0, 1, 2, 3].filter(i => above[i] > 0), lower = [0, 1, 2, 3].filter(i => above[i] <= 0);
    const between = (a, b) => p[a].map((from, i) => from + above[a] / (above[a] - above[b]) * (p[b][i] - from));
    const colour = colourOf(elements, k);
    if (upper.length === 2) {
      const q = [between(upper[0], lower[0]), between(upper[0], lower[1]), between(upper[1], lower[1]), between(upper[1], lower[0])];
      shown.add(q[0], q[1], q[2], colour, 1);
      shown.add(q[0], q[2], q[3], colour, 2);
    } else {
      const [[top], others] = upper.length === 1 ? [upper, lower] : [lower, upper];
      shown.add(...others.map(other => between(top, other)), colour);
    }
  }
  return shown;
}
function outlinePlaces() {
  const all = new Float32Array(6 * outline.pieces.length);
  for (let k = 0; k < outline.pieces.length; ++k) {
    const [a, b] = cornersOf(outline, 2, k);
    all.set(a, 6 * k);
    all.set(b, 6 * k + 3);
  }
  return all;
}

// Marks are cut with the mesh, and seen through it, since most are inside of it. They are of no piece, and would be elsewhere
// than what they mark once pieces are apart.
function shownMarks() {
  if (!state.marks || state.apart > 0) return [];
  const {normal, place} = state.cut || {normal: [0, 0, 0], place: 0};
  return data.marks.all.filter(({at}) => normal[0] * at[0] + normal[1] * at[1] + normal[2] * at[2] <= place);
}

// What this page lacks of what is shown, in words: where it is not, the mesh has no hole.
function gaps() {
  const text = count => count.toLocaleString("en"), some = (here, all) => `${text(here)} of ${text(all)}`;
  const here = elements.pieces.length, all = solid ? data.count : 0, isSection = state.cut !== null && solid;
  const outer = triangles.outer, inner = triangles.pieces.length - outer;
  return [
    outer < data.outer && `The surface has gaps, as this page has ${some(outer, data.outer)} triangles.`,
    inner < data.inner && `There are gaps between pieces, as this page has ${some(inner, data.inner)} triangles there.`,
    here === 0 && all > 0 && (isSection || state.under !== null) &&
      `This page has none of the ${text(all)} elements inside; dovetail view --png draws them.`,
    here > 0 && here < all && isSection && `The section has gaps, as this page has ${some(here, all)} elements; dovetail view --png --cut draws all.`,
    here > 0 && here < all && state.under !== null && state.under > data.complete &&
      `Elements under ${data.complete.toFixed(1)}° are all here, and some of the others.`
  ].filter(Boolean).join(" ");
}
