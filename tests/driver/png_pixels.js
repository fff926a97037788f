// The pixels of PNG files with 8 bits of RGB or RGBA.
"use strict";

// A function of "x,y" that says "red green blue".
function pixel_reader(bytes) {
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
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (line + 1)]; // of the PNG specification, 9.2
    for (let x = 0; x < line; ++x) {
      const left = x < channels ? 0 : pixels[y * line + x - channels], up = y ? pixels[(y - 1) * line + x] : 0;
      let guess = 0;
      if (filter === 1) guess = left;
      else if (filter === 2) guess = up;
      else if (filter === 3) guess = (left + up) >> 1;
      else if (filter === 4) {
        const corner = y && x >= channels ? pixels[(y - 1) * line + x - channels] : 0;
        const a = Math.abs(up - corner), b = Math.abs(left - corner), c = Math.abs(left + up - 2 * corner);
        guess = a <= b && a <= c ? left : b <= c ? up : corner;
      }
      pixels[y * line + x] = raw[y * (line + 1) + 1 + x] + guess;
    }
  }
  return place => {
    const [x, y] = place.split(",").map(Number);
    return pixels.subarray(y * line + x * channels, y * line + x * channels + 3).join(" ");
  };
}

module.exports = {pixel_reader};
