// The places of points in the moments of a sequence (point_moments.h).

class Moments {
  constructor(data) {
    this.count = data.count;
    this.first = numbersOf(data.first);
    this.last = numbersOf(data.last);
    // The places of moment m begin at m * points * 3; null if the points stand still.
    this.places = data.places ? pointsOf(data.places) : null;
  }

  // Returns the moment at `at` of the way, which is 0 at the first and 1 at the last one.
  momentAt(at) { return Math.round(clamp(at) * (this.count - 1)); }

  move(points, at) {
    if (!this.places) return points;
    const begin = this.momentAt(at) * points.length;
    return this.places.subarray(begin, begin + points.length);
  }

  // Returns the points that are there, as indices.
  shownAt(at) {
    const moment = this.momentAt(at), shown = [];
    for (let i = 0; i < this.first.length; ++i) {
      if (this.first[i] <= moment && moment <= this.last[i]) shown.push(i);
    }
    return shown;
  }
}
