// A surface with the figures of its points (view_surface.h).

class SurfaceData {
  constructor(data) {
    this.name = data.name;
    this.spacing = data.spacing;
    this.points = pointsOf(data.points);
    this.count = this.points.length / 3;
    this.faces = numbersOf(data.faces);
    this.rows = numbersOf(data.rows);
    // Values that are hidden are grey, and told all the same.
    this.fields = data.fields.map((field) => Object.assign({}, field, {
      values: valuesOf(field), hidden: field.hidden ? numbersOf(field.hidden) : null}));
    this.motion = data.motion ? new WarpMotion(data.motion) : null;
    this.moments = data.moments ? new Moments(data.moments) : null;
    // Red, green and blue of each point, and its normal; null if they are not known.
    this.colors = data.colors ? bytesOf(data.colors) : null;
    this.normals = data.normals ? pointsOf(data.normals) : null;
  }

  placesAt(at) {
    if (this.moments) return this.moments.move(this.points, at);
    return this.motion ? this.motion.move(this.points, at) : this.points;
  }
  field(key) { return this.fields.find((field) => field.key === key); }
  // Returns one value of a field for each point at `at` of the way.
  valuesAt(field, at) {
    if (field.values.length === this.count || !this.moments) return field.values;
    const begin = this.moments.momentAt(at) * this.count;
    return field.values.subarray(begin, begin + this.count);
  }
  isThere(point, at) {
    if (!this.moments) return true;
    const moment = this.moments.momentAt(at);
    return this.moments.first[point] <= moment && moment <= this.moments.last[point];
  }
  pointOfRow(row) { return this.rows.indexOf(row); }
}
