// node browser_shots.js BROWSER FOLDER x,y...: for each line "NAME ADDRESS [WIDTH HEIGHT]" of the standard input, a picture
// FOLDER/NAME.png of the page when it has drawn, 1000 times 700 pixels, whichever size it was loaded in; prints "NAME x,y red green
// blue" of these pixels. One Chromium without a window makes all.
// It is asked by its protocol over pipes (https://chromedevtools.github.io/devtools-protocol), which tells when a page is there:
// nothing waits for a time.
const fs = require("fs"), path = require("path"), {pixel_reader} = require("./png_pixels.js");
const [, , browser, folder, ...places] = process.argv;
const shots = fs.readFileSync(0, "utf8").trim().split("\n").map(line => line.split(" "));

// As root, and in containers, there is neither a sandbox nor much shared memory.
const child = require("child_process").spawn(browser, ["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu",
  "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run",
  `--user-data-dir=${path.join(folder, "profile")}`, "--remote-debugging-pipe", "about:blank"],
  {stdio: ["ignore", "ignore", "pipe", "pipe", "pipe"]});
let said = "";
child.stderr.on("data", text => { said += text; });
function fail(why) {
  console.error(`${why}\n${said.slice(-2000)}`);
  child.kill("SIGKILL");
  process.exit(1);
}
child.on("error", problem => fail(`the browser does not start: ${problem.message}`));
child.on("exit", code => fail(`the browser has ended with ${code}`));
child.stdio[3].on("error", () => {}); // the exit says it

const answers = new Map(), awaited = new Map();
let asked = 0, received = "";
child.stdio[4].setEncoding("utf8").on("data", text => {
  const messages = (received + text).split("\0");
  received = messages.pop();
  for (const {id, error, result, method, sessionId} of messages.map(JSON.parse)) {
    if (error) fail(error.message);
    if (id) answers.get(id)(result);
    else awaited.get(`${sessionId} ${method}`)?.();
  }
});
function ask(method, params = {}, sessionId = undefined) {
  child.stdio[3].write(`${JSON.stringify({id: ++asked, method, params, sessionId})}\0`);
  return new Promise(resolve => answers.set(asked, resolve));
}

async function shoot(name, url, ...firstSize) {
  const {targetId} = await ask("Target.createTarget", {url: "about:blank"});
  const {sessionId} = await ask("Target.attachToTarget", {targetId, flatten: true});
  const loaded = new Promise(resolve => awaited.set(`${sessionId} Page.loadEventFired`, resolve));
  const resize = (width, height) => ask("Emulation.setDeviceMetricsOverride", {width, height, deviceScaleFactor: 1, mobile: false}, sessionId);
  const [width = 1000, height = 700] = firstSize.map(Number);
  await resize(width, height);
  await ask("Page.enable", {}, sessionId);
  const {errorText} = await ask("Page.navigate", {url}, sessionId);
  if (errorText) fail(`${url}: ${errorText}`);
  await loaded;
  // The page draws in the first frame.
  const twoFrames = size => ask("Runtime.evaluate", {awaitPromise: true, expression: `new Promise(done => {
    const frame = () => innerWidth === ${size} ? requestAnimationFrame(() => requestAnimationFrame(done)) : requestAnimationFrame(frame);
    frame();
  })`}, sessionId);
  await twoFrames(width);
  if (firstSize.length) {
    await resize(1000, 700);
    await twoFrames(1000);
  }
  const {data} = await ask("Page.captureScreenshot", {optimizeForSpeed: true}, sessionId);
  const picture = Buffer.from(data, "base64"), pixel = pixel_reader(picture);
  fs.writeFileSync(path.join(folder, `${name}.png`), picture);
  for (const place of places) console.log(name, place, pixel(place));
  await ask("Target.closeTarget", {targetId});
}

(async () => {
  for (const shot of shots) await shoot(...shot);
  child.removeAllListeners("exit").on("exit", () => process.exit(0));
  ask("Browser.close");
})();
