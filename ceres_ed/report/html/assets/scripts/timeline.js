// The frames of a sequence: a slider, plots that can be clicked, the picture of a frame, and what is
// known of it in words.

// A camera in one frame (map_from_camera).
class Pose {
  constructor(numbers) {
    this.center = Array.from(numbers.subarray(0, 3));
    this.rotation = partOfRotation(numbers[3], numbers[4], numbers[5], numbers[6], 1);
  }
  act(point) {
    const r = this.rotation;
    return [0, 1, 2].map((i) => r[3 * i] * point[0] + r[3 * i + 1] * point[1] +
        r[3 * i + 2] * point[2] + this.center[i]);
  }
}

class Timeline {
  constructor(data) {
    this.data = data;
    this.camera = data.camera;
    // The frames of the run, and which of them are shown: the moments.
    this.frames = data.frames;
    this.moments = data.moments;
    const poses = new Float64Array(bytesOf(data.poses).buffer);
    this.poses = data.frames.map((frame, i) => {
      const numbers = poses.subarray(7 * i, 7 * i + 7);
      return numbers.some(Number.isNaN) ? null : new Pose(numbers);
    });
    this.tracks = data.tracks.map((track) => ({
      id: track.id, moments: track.moments,
      places: Array.from(new Float64Array(bytesOf(track.places).buffer))}));
    this.images = data.pictures.map(() => null);
    this.moment = -1;
  }

  momentAt(way) { return Math.round(clamp(way) * (this.moments.length - 1)); }
  wayOf(moment) { return this.moments.length > 1 ? moment / (this.moments.length - 1) : 1; }
  frameOf(moment) { return this.frames[this.moments[moment]]; }
  poseOf(moment) { return this.poses[this.moments[moment]]; }

  // Returns the moment whose frame is nearest to a frame's number.
  nearestMoment(number) {
    let best = 0;
    this.moments.forEach((frame, m) => {
      const gap = (k) => Math.abs(this.frames[this.moments[k]].number - number);
      if (gap(m) < gap(best)) best = m;
    });
    return best;
  }

  show(way) {
    const moment = this.moment = this.momentAt(way);
    const frame = this.frameOf(moment);
    const slider = byId('frame');
    if (slider) {
      slider.value = moment;
      slider.setAttribute('aria-valuetext', 'frame ' + frame.number + ', ' + frame.status);
    }
    byId('frameText').value = frame.text;
    this.showPicture(moment);
    this.markPlots(frame.number);
  }

  // Draws the picture of a moment with the points that are followed.
  showPicture(moment) {
    const canvas = byId('photo');
    if (!canvas) return;
    const picture = this.data.pictures[moment];
    byId('photoFigure').hidden = !this.data.pictures.some((one) => one);
    canvas.setAttribute('aria-label', picture
        ? 'Colour picture of frame ' + this.frameOf(moment).number + ' with ' +
            picture.ids.length + ' points that are followed'
        : 'There is no picture of frame ' + this.frameOf(moment).number);
    const pen = canvas.getContext('2d');
    if (!picture) return pen.clearRect(0, 0, canvas.width, canvas.height);
    let image = this.images[moment];
    if (!image) {
      image = this.images[moment] = new Image();
      image.onload = () => { if (this.moment === moment) this.showPicture(moment); };
      image.src = 'data:image/jpeg;base64,' + picture.jpeg;
    }
    if (!image.complete || image.naturalWidth === 0) return;
    canvas.width = picture.width;
    canvas.height = picture.height;
    pen.drawImage(image, 0, 0);
    if (byId('marks').checked) this.drawMarks(pen, moment);
  }

  drawMarks(pen, moment) {
    const picture = this.data.pictures[moment];
    const before = moment > 0 ? this.data.pictures[moment - 1] : null;
    picture.ids.forEach((id, i) => {
      const [x, y] = picture.pixels.slice(2 * i, 2 * i + 2);
      const was = before ? before.ids.indexOf(id) : -1;
      for (const [color, width] of [['#000', 3.2], ['#ffd23f', 1.6]]) {
        pen.strokeStyle = color;
        pen.lineWidth = width;
        pen.beginPath();
        if (was >= 0) {
          pen.moveTo(before.pixels[2 * was], before.pixels[2 * was + 1]);
          pen.lineTo(x, y);
        }
        pen.moveTo(x + 2.5, y);
        pen.arc(x, y, 2.5, 0, 2 * Math.PI);
        pen.stroke();
      }
    });
  }

  // Moves the line that stands at the frame in every plot over frames.
  markPlots(number) {
    for (const plot of document.querySelectorAll('svg.frames')) {
      const line = plot.querySelector('.now');
      const d = plot.dataset, width = Number(d.high) - Number(d.low);
      const part = width > 0 ? (number - Number(d.low)) / width : 0;
      const x = Number(d.left) + part * (Number(d.right) - Number(d.left));
      line.setAttribute('x1', x);
      line.setAttribute('x2', x);
    }
  }
}

// Returns the number of the frame at a place of a plot, in CSS pixels of the window.
function frameAtClick(plot, clientX) {
  const box = plot.getBoundingClientRect(), d = plot.dataset;
  const x = (clientX - box.left) / box.width * plot.viewBox.baseVal.width;
  const part = clamp((x - Number(d.left)) / (Number(d.right) - Number(d.left)));
  return Number(d.low) + part * (Number(d.high) - Number(d.low));
}

function addTimeline(view) {
  const {timeline} = view;
  const choose = (moment) => view.setWay(timeline.wayOf(moment));
  on('frame', 'input', () => { stopPlaying(view); choose(Number(byId('frame').value)); });
  on('marks', 'change', () => timeline.showPicture(timeline.moment));
  on('path', 'change', () => {
    for (const panel of view.panels) if (panel.path) panel.path.visible = byId('path').checked;
    view.draw();
  });
  for (const plot of document.querySelectorAll('svg.frames')) {
    plot.addEventListener('click', (event) => {
      stopPlaying(view);
      choose(timeline.nearestMoment(frameAtClick(plot, event.clientX)));
    });
  }
}
