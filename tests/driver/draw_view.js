// node draw_view.js PAGE: runs the scripts of a page of `dovetail view` and prints what they draw for some positions of the
// controls, one "key value" on each line, without a browser: the page and WebGL are stand-ins, three.js is the page's own.
const [, , file] = process.argv;
const page = require("fs").readFileSync(file, "utf8");
const script = id => page.match(new RegExp(`<script id="${id}"[^>]*>([^]*?)</script>`))[1];

class stand_in {
  constructor(tag = "", attributes = "") {
    const said = name => (attributes.match(new RegExp(` ${name}="([^"]*)"`)) || [, ""])[1];
    Object.assign(this, {tag, type: said("type"), value: said("value"), checked: / checked/.test(attributes),
      open: / open/.test(attributes), style: {}, listeners: {},
      dataset: {from: said("data-from")}, children: [], textContent: "", width: 300, height: 150});
  }
  addEventListener(name, listener) { this.listeners[name] = listener; }
  append(...items) { this.children.push(...items); }
  replaceChildren(...items) { this.children = items; }
  insertBefore(item) { this.children.unshift(item); }
  set(value) { Object.assign(this, value); this.listeners.input(); }
  get firstChild() { return this.children[0]; }
}
const markup = page.slice(page.indexOf("<details"), page.indexOf('<script id="three"'));
const tags = [...markup.matchAll(/<(\w+)((?: [^<>]*)?)>/g)].map(([, tag, attributes]) => [attributes, new stand_in(tag, attributes)]);
const byId = {data: {textContent: script("data")}};
for (const [attributes, element] of tags) {
  const id = attributes.match(/ id="(\w+)"/);
  if (id) byId[id[1]] = element;
}
byId.colours.value = "group"; // as a browser chooses the first option
const frames = [], rendered = [];
const document = {body: new stand_in("body"), title: "", getElementById: id => byId[id], createElement: tag => new stand_in(tag),
  querySelectorAll: () => tags.filter(([attributes]) => attributes.includes("data-from")).map(([, element]) => element)};
globalThis.self = globalThis;
new Function("exports", "module", "define", script("three"))();
THREE.WebGLRenderer = class {
  constructor() { this.domElement = new stand_in("canvas"); }
  setPixelRatio() {}
  setSize() {}
  render(scene, camera) { rendered.push({scene, camera}); }
};
const ofWindow = {};
Object.assign(globalThis, {innerWidth: 800, innerHeight: 600, devicePixelRatio: 1});
const run = new Function("document", "location", "addEventListener", "requestAnimationFrame",
  script("model") + script("show") + "return {layers, lines, discs, hiddenDiscs, state, eye, uniforms, onScreen, half, panelWidth};");
const shown = run(document, {hash: "#edges=0"}, (name, listener) => { ofWindow[name] = listener; }, frame => frames.push(frame));

const areaOf = ({geometry}) => {
  const p = geometry.attributes.position.array;
  let sum = 0;
  for (let k = 0; k < p.length; k += 9) {
    const at = i => new THREE.Vector3(p[k + 3 * i], p[k + 3 * i + 1], p[k + 3 * i + 2]);
    sum += new THREE.Triangle(at(0), at(1), at(2)).getArea();
  }
  return sum;
};
const count = ({geometry}) => geometry.attributes.position.count / 3;
const print = (key, value) => console.log(key, typeof value === "number" ? +value.toFixed(4) : value);
function settle() { while (frames.length) frames.shift()(); }
function report(name) {
  settle();
  const {surface, section, ghost} = shown.layers;
  for (const [what, layer] of Object.entries({surface, section, ghost})) print(`${name}.${what}`, count(layer));
  print(`${name}.area`, areaOf(section));
  print(`${name}.gaps`, byId.gaps.textContent || "none");
  const box = new THREE.Box3().setFromBufferAttribute(surface.geometry.attributes.position);
  print(`${name}.width`, count(surface) ? box.max.x - box.min.x : 0);
}
print("title", document.title);
print("figures", byId.figures.textContent);
print("groups", byId.groups.children.length);
print("edges", shown.uniforms.edges.value);
report("whole");
byId.cut.set({value: "x"});
byId.place.set({value: 0.25});
report("cut");
print("cut.place", shown.uniforms.plane.value.w);
byId.cut.set({value: "view"});
report("view");
byId.cut.set({value: ""});
byId.apart.set({value: 1});
report("apart");
byId.apart.set({value: 0});
byId.under.set({value: 44});
report("under44");
byId.under.set({value: 46});
report("under46");
function legend(name) {
  const [first, degrees] = byId.legend.children;
  const rows = first && first.className === "scale" ? degrees.children.map(({textContent}) => textContent)
    : byId.legend.children.map(({children: [patch, text]}) => `${patch.style.background} ${text}`);
  print(`legend.${name}`, `${rows.join(" ") || "none"}; groups have ${byId.groups.className ? "none" : "colours"}`);
}
legend("under");
byId.under.set({value: 71});
byId.none.listeners.click();
report("none");
byId.all.listeners.click();
report("all");
byId.groups.children[0].children[0].checked = false;
byId.groups.children[0].children[0].listeners.input();
report("without");
for (const colours of ["piece", "material", "angle", "group"]) {
  byId.colours.set({value: colours});
  settle();
  legend(colours);
  print(`colour.${colours}`, Array.from((shown.layers.surface.geometry.attributes.colour || {array: []}).array.slice(0, 3)).join(","));
}
const canvas = document.body.children[0];
canvas.setPointerCapture = () => {};
const countMarks = name => { settle(); print(`marks.${name}`, shown.discs.geometry.attributes.position.count); };
const told = ([x, y]) => {
  canvas.listeners.pointermove({clientX: x, clientY: y});
  return byId.mark.hidden ? "nothing" : byId.mark.textContent;
};
countMarks("all");
print("marks.hidden", shown.hiddenDiscs.geometry.attributes.position.count);
print("marks.note", byId.marksNote.textContent);
print("marks.disabled", byId.marks.disabled);
print("marks.labels", byId.markLabels.children.map(({children}) => `${children[1]} ${children[0].style.background}`).join("; ") || "none");
print("marks.control", byId.marked.hidden ? "hidden" : "shown");
const [first] = JSON.parse(script("data")).marks.all;
if (first) {
  print("marks.last", Array.from(shown.discs.geometry.attributes.position.array.slice(-3)).join(","));
  const [x, y] = shown.onScreen(first.at);
  const {camera} = rendered[rendered.length - 1]; // which has to see the mark where it is looked for
  camera.updateMatrixWorld();
  const seen = new THREE.Vector3(...first.at).project(camera);
  print("marks.offset", Math.hypot((seen.x + 1) * 400 - x, (1 - seen.y) * 300 - y));
  print("marks.told", told([x + 3, y - 3]));
  print("marks.beside", told([x + 9, y + 9]));
}
byId.cut.set({value: "x"});
countMarks("cut");
byId.cut.set({value: ""});
byId.apart.set({value: 1});
countMarks("apart");
print("marks.noteApart", byId.marksNote.textContent);
print("marks.disabledApart", byId.marks.disabled);
byId.apart.set({value: 0});
byId.marks.set({checked: false});
countMarks("none");
byId.marks.set({checked: true});
settle();
const event = (x, y, more = {}) => ({pointerId: 1, clientX: x, clientY: y, buttons: 1, preventDefault() {}, ...more});
const before = {...shown.eye};
canvas.listeners.pointerdown(event(0, 0));
canvas.listeners.pointermove(event(10, 0));
print("turned", shown.eye.azimuth - before.azimuth);
canvas.listeners.pointermove(event(20, 0, {buttons: 2}));
print("moved", Math.hypot(...shown.eye.target) > 0);
canvas.listeners.pointerdown(event(120, 0, {pointerId: 2}));
canvas.listeners.pointermove(event(220, 0, {pointerId: 2}));
print("pinched", shown.eye.away / before.away);
canvas.listeners.pointerup(event(0, 0));
canvas.listeners.pointerup(event(0, 0, {pointerId: 2}));
canvas.listeners.wheel({deltaY: 100, preventDefault() {}});
settle();
print("rendered", rendered.length > 0);

// Whether all of the mesh is on the screen, beside the panel.
function fits() {
  const corners = [...Array(8).keys()].map(k => shown.half.map((length, i) => k >> i & 1 ? length : -length)).map(shown.onScreen);
  return corners.every(([x, y]) => x > shown.panelWidth() && x < innerWidth && y > 0 && y < innerHeight);
}
function resize(width) {
  globalThis.innerWidth = width;
  ofWindow.resize();
}
function toggle(open) {
  byId.panel.open = open;
  byId.panel.listeners.toggle();
}
const [, home] = tags.find(([attributes]) => attributes.includes('data-from=""'));
home.listeners.click();
print("fits.home", fits());
toggle(false);
const wide = shown.eye.away;
resize(400);
print("fits.narrow", fits());
resize(720);
toggle(true);
print("fits.panel", fits());
toggle(false);
resize(800);
print("fits.back", shown.eye.away === wide);
function drag() {
  canvas.listeners.pointerdown(event(0, 0));
  canvas.listeners.pointermove(event(9, 0));
  canvas.listeners.pointerup(event(9, 0));
}
const zoom = () => canvas.listeners.wheel({deltaY: -100, preventDefault() {}});
for (const [how, move] of Object.entries({turned: drag, zoomed: zoom})) {
  home.listeners.click();
  move();
  const {away} = shown.eye;
  resize(720);
  toggle(true);
  print(`stays.${how}`, shown.eye.away === away);
  toggle(false);
  resize(800);
}
