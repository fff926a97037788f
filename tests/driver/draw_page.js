// node draw_page.js PAGE: runs the script of a page of `dovetail compare` and prints the body that it makes, as one
// element, without a browser.
const [, , file] = process.argv;
const page = require("fs").readFileSync(file, "utf8");
const script = id => page.match(new RegExp(`<script id="${id}"[^>]*>([^]*?)</script>`))[1];
const body = {innerHTML: ""};
const document = {body, getElementById: id => ({textContent: script(id)}), querySelectorAll: () => []};
new Function("document", script("draw"))(document);
console.log(`<body>\n${body.innerHTML}</body>`);
