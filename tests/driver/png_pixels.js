// node png_pixels.js FILE x,y...: prints "red green blue" of these pixels of a PNG file with 8 bits of RGB or RGBA.
const [, , file, ...places] = process.argv;
const bytes = require("fs").readFileSync(file);
let width, height, channels;
const packed = [];
for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at)) {
  const kind = bytes.toString("latin1", at + 4, at + 8), body = bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at));
  if (kind === "IHDR") {
    [width, height] = [body.readUInt32BE(0), body.readUInt32BE(4)];
    if (body[8] !== 8 || ![2, 6].includes(body[9]) || body[12] !== 0) throw new Error("another kind of PNG");
    channels = body[9] === 6 ? 4 : 3;
  }
  if (kind === "IDAT") packed.push(body);
}
const raw = require("zlib").inflateSync(Buffer.concat(packed)), line = width * channels, pixels = Buffer.alloc(line * height);
for (let y = 0; y < height; ++y)
  for (let x = 0; x < line; ++x) { // filters of the PNG specification, 9.2
    const left = x < channels ? 0 : pixels[y * line + x - channels], up = y ? pixels[(y - 1) * line + x] : 0;
    const corner = y && x >= channels ? pixels[(y - 1) * line + x - channels] : 0, guess = left + up - corner;
    const [a, b, c] = [left, up, corner].map(value => Math.abs(guess - value));
    const nearest = a <= b && a <= c ? left : b <= c ? up : corner;
    pixels[y * line + x] = raw[y * (line + 1) + 1 + x] + [0, left, up, (left + up) >> 1, nearest][raw[y * (line + 1)]];
  }
for (const place of places) {
  const [x, y] = place.split(",").map(Number);
  console.log(...pixels.subarray(y * line + x * channels, y * line + x * channels + 3));
}
