// node sort_page.js PAGE COLUMN: runs the script of a page of `dovetail compare` on stand-ins of its tables, without a browser, and
// prints what is in a column of the first table as the page has it, after a click on the column's head, and after another one.
const [, , file, column] = process.argv;
const page = require("fs").readFileSync(file, "utf8");
const all = (text, name) => [...text.matchAll(new RegExp(`<${name}(?: [^>]*)?>([^]*?)</${name}>`, "g"))].map(([, inside]) => inside);
const tables = all(page, "table").map(text => {
  const body = {rows: all(all(text, "tbody")[0], "tr").map(row => ({cells: all(row, "td").map(textContent => ({textContent}))})),
    append(...rows) { this.rows = rows; }};
  const heads = all(text, "th").map((textContent, cellIndex) => ({textContent, cellIndex, dataset: {}, closest: () => ({tBodies: [body]})}));
  return {body, heads};
});
const said = {hidden: true};
const document = {body: {classList: {add() {}}}, getElementById: () => said, querySelectorAll: () => tables.flatMap(({heads}) => heads)};
new Function("document", page.match(/<script id="sort">([^]*?)<\/script>/)[1])(document);
const [{body, heads}] = tables, head = heads.find(({textContent}) => textContent === column);
const print = () => console.log(body.rows.map(({cells}) => cells[head.cellIndex].textContent).join(" "));
print();
head.onclick();
print();
head.onclick();
print();
console.log(said.hidden ? "not said" : "said");
