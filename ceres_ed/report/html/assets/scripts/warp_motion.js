// The way of a surface from where it was given to its fitted place (warp_motion.h).

// Returns the rotation matrix, row by row, of a part of the rotation q = [w, x, y, z].
function partOfRotation(w, x, y, z, part) {
  if (w < 0) { w = -w; x = -x; y = -y; z = -z; }
  const sine = Math.hypot(x, y, z);
  const half = Math.atan2(sine, w) * part;
  const factor = sine > 0 ? Math.sin(half) / sine : 0;
  w = Math.cos(half); x *= factor; y *= factor; z *= factor;
  return [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
          2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
}

class WarpMotion {
  constructor(data) {
    this.stride = data.stride;
    this.nodes = new Float64Array(bytesOf(data.nodes).buffer);
    this.bound = numbersOf(data.bound);
    this.weights = Float64Array.from(new Uint16Array(bytesOf(data.weights).buffer),
                                     (w) => w / 65534);
    for (let i = 0; this.stride > 0 && i < this.weights.length; i += this.stride) {
      let sum = 0;
      for (let k = 0; k < this.stride; ++k) sum += this.weights[i + k];
      for (let k = 0; k < this.stride; ++k) this.weights[i + k] /= sum;
    }
    this.finish = data.finish ? pointsOf(data.finish) : null;
    this.share = data.placement;
    this.end = data;
  }

  partsAt(at) {
    return {placed: this.share > 0 ? clamp(at / this.share) : 1,
            bent: clamp((at - this.share) / (1 - this.share))};
  }

  // Twelve numbers a node: A row by row, and g + t - A g, so that a point goes to A v + rest.
  nodesAt(bent) {
    const count = this.nodes.length / 16;
    const out = new Float64Array(12 * count);
    for (let j = 0; j < count; ++j) {
      const n = this.nodes.subarray(16 * j, 16 * j + 16);
      const r = partOfRotation(n[3], n[4], n[5], n[6], bent);
      const s = [1 + bent * (n[7] - 1), bent * n[8], bent * n[9],
                 bent * n[8], 1 + bent * (n[10] - 1), bent * n[11],
                 bent * n[9], bent * n[11], 1 + bent * (n[12] - 1)];
      for (let row = 0; row < 3; ++row) {
        let moved = 0;
        for (let column = 0; column < 3; ++column) {
          const a = r[3 * row] * s[column] + r[3 * row + 1] * s[3 + column] +
              r[3 * row + 2] * s[6 + column];
          out[12 * j + 3 * row + column] = a;
          moved += a * n[column];
        }
        out[12 * j + 9 + row] = n[row] + bent * n[13 + row] - moved;
      }
    }
    return out;
  }

  // Returns a function that places a point of the source's frame in that of the target.
  placer(placed) {
    const e = this.end, c = e.center;
    const full = partOfRotation(...e.rotation, 1);
    const r = partOfRotation(...e.rotation, placed);
    const scale = Math.pow(e.scale, placed);
    const center = [0, 1, 2].map((i) => {
      const at = e.scale * (full[3 * i] * c[0] + full[3 * i + 1] * c[1] + full[3 * i + 2] * c[2]) +
          e.translation[i];
      return c[i] + placed * (at - c[i]);
    });
    return (x, y, z, out, at) => {
      x -= c[0]; y -= c[1]; z -= c[2];
      for (let i = 0; i < 3; ++i) {
        out[at + i] =
            scale * (r[3 * i] * x + r[3 * i + 1] * y + r[3 * i + 2] * z) + center[i];
      }
    };
  }

  move(points, at) {
    const {placed, bent} = this.partsAt(at);
    const nodes = this.nodesAt(bent), place = this.placer(placed);
    const out = new Float64Array(points.length);
    for (let i = 0; i < points.length / 3; ++i) {
      const x = points[3 * i], y = points[3 * i + 1], z = points[3 * i + 2];
      let mx = this.stride ? 0 : x, my = this.stride ? 0 : y, mz = this.stride ? 0 : z;
      for (let k = i * this.stride; k < (i + 1) * this.stride; ++k) {
        const w = this.weights[k];
        if (w === 0) continue;
        const j = 12 * this.bound[k];
        mx += w * (nodes[j] * x + nodes[j + 1] * y + nodes[j + 2] * z + nodes[j + 9]);
        my += w * (nodes[j + 3] * x + nodes[j + 4] * y + nodes[j + 5] * z + nodes[j + 10]);
        mz += w * (nodes[j + 6] * x + nodes[j + 7] * y + nodes[j + 8] * z + nodes[j + 11]);
      }
      if (this.finish) {
        mx += bent * this.finish[3 * i];
        my += bent * this.finish[3 * i + 1];
        mz += bent * this.finish[3 * i + 2];
      }
      place(mx, my, mz, out, 3 * i);
    }
    return out;
  }

  nodePlaces(at) {
    const {placed, bent} = this.partsAt(at), place = this.placer(placed);
    const out = new Float64Array(this.nodes.length / 16 * 3);
    for (let j = 0; j < out.length / 3; ++j) {
      const n = this.nodes.subarray(16 * j, 16 * j + 16);
      place(n[0] + bent * n[13], n[1] + bent * n[14], n[2] + bent * n[15], out, 3 * j);
    }
    return out;
  }
}
