// The view of a report: surfaces in panels with one camera, coloured by figures of their points,
// moved along their way, and asked for the figures of a vertex. Data come from scene_data.cc. Where
// there is no WebGL the page keeps its picture.
(function () {
  'use strict';

  const page = window.ceresEd = {ready: false, errors: []};
  window.addEventListener('error', (event) => page.errors.push(String(event.message)));
  const byId = (id) => document.getElementById(id);

  for (const button of document.querySelectorAll('button.copy')) {
    button.addEventListener('click', () => {
      const text = button.parentElement.querySelector('pre').textContent;
      const done = () => { button.textContent = 'Copied'; };
      if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, () => {});
    });
  }
  // A printed page shows what is folded.
  window.addEventListener('beforeprint', () => {
    for (const part of document.querySelectorAll('details')) part.open = true;
  });

  const element = byId('scene');
  if (!element) return;

  // ---- Data --------------------------------------------------------------------------------------

  function bytesOf(text) {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
  }
  const numbersOf = (data) => data.bits === 32 ? new Uint32Array(bytesOf(data.data).buffer)
                                               : new Uint16Array(bytesOf(data.data).buffer);
  function pointsOf(data) {
    const steps = new Uint16Array(bytesOf(data.steps).buffer);
    const points = new Float64Array(steps.length);
    for (let i = 0; i < steps.length; ++i) {
      const low = data.low[i % 3];
      points[i] = low + steps[i] / 65535 * (data.high[i % 3] - low);
    }
    return points;
  }
  // Values of a field; unknown ones are NaN.
  function valuesOf(field) {
    const steps = new Uint16Array(bytesOf(field.steps).buffer);
    return Float64Array.from(
        steps, (s) => s === 65535 ? NaN : field.min + s / 65534 * (field.max - field.min));
  }
  const short = (value) => Number.isFinite(value) ? String(Number(value.toPrecision(4))) : 'unknown';

  // ---- The way of a surface (warp_motion.h) ------------------------------------------------------

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

  const clamp = (value) => Math.min(1, Math.max(0, value));

  class Motion {
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

  class SurfaceData {
    constructor(data) {
      this.name = data.name;
      this.points = pointsOf(data.points);
      this.count = this.points.length / 3;
      this.faces = numbersOf(data.faces);
      this.rows = numbersOf(data.rows);
      this.fields = data.fields.map((field) => Object.assign({values: valuesOf(field)}, field));
      this.motion = data.motion ? new Motion(data.motion) : null;
    }
    placesAt(at) { return this.motion ? this.motion.move(this.points, at) : this.points; }
    field(key) { return this.fields.find((field) => field.key === key); }
    pointOfRow(row) { return this.rows.indexOf(row); }
  }

  const data = JSON.parse(element.textContent);
  const surfaces = data.surfaces.map((surface) => new SurfaceData(surface));
  const radius = data.radius;
  const colors = {magnitude: bytesOf(data.colors.magnitude), signed: bytesOf(data.colors.signed)};
  page.surfaces = surfaces;

  // Where there is no WebGL, or no three.js, the picture stays.
  const canvas = byId('view');
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
  } catch (error) {
    byId('stillText').textContent = 'This browser has no WebGL, so there is a picture only.';
    return;
  }
  byId('viewer').hidden = false;
  byId('still').hidden = true;
  renderer.autoClear = false;
  renderer.setPixelRatio(window.devicePixelRatio || 1);

  // ---- Panels ------------------------------------------------------------------------------------

  const cssColor = (name) =>
      new THREE.Color(getComputedStyle(document.body).getPropertyValue(name).trim());
  const toView = (places) => {
    const out = new Float32Array(places.length);
    for (let i = 0; i < places.length; ++i) out[i] = (places[i] - data.center[i % 3]) / radius;
    return out;
  };

  // A round dot, for points that are marked.
  const dot = document.createElement('canvas');
  dot.width = dot.height = 32;
  const pen = dot.getContext('2d');
  pen.fillStyle = '#fff';
  pen.arc(16, 16, 15, 0, 2 * Math.PI);
  pen.fill();
  const round = {map: new THREE.CanvasTexture(dot), alphaTest: 0.5, sizeAttenuation: false};

  class Panel {
    constructor(data, number) {
      this.data = data;
      this.surface = surfaces[data.surface];
      this.number = number;
      this.scene = new THREE.Scene();
      this.light = new THREE.DirectionalLight(0xffffff, 0.55);
      this.scene.add(new THREE.AmbientLight(0xffffff, 0.55), this.light, this.light.target);
      this.geometry = new THREE.BufferGeometry();
      const count = this.surface.count;
      this.position = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
      this.color = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
      this.geometry.setAttribute('position', this.position);
      this.geometry.setAttribute('color', this.color);
      this.hasFaces = this.surface.faces.length > 0;
      if (this.hasFaces) {
        this.geometry.setIndex(new THREE.BufferAttribute(this.surface.faces, 1));
        this.material = new THREE.MeshLambertMaterial(
            {vertexColors: THREE.VertexColors, side: THREE.DoubleSide,
             // Edges and graph, which lie on the surface, are seen.
             polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8});
        this.body = new THREE.Mesh(this.geometry, this.material);
        this.wire = new THREE.Mesh(this.geometry, new THREE.MeshBasicMaterial(
            {wireframe: true, transparent: true, opacity: 0.3, color: 0x000000}));
        this.wire.visible = false;
        this.scene.add(this.wire);
      } else {
        this.material = new THREE.PointsMaterial(
            {size: 4.5 / Math.sqrt(count), vertexColors: THREE.VertexColors});
        this.body = new THREE.Points(this.geometry, this.material);
      }
      this.scene.add(this.body);
      this.marker = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial(
          {...round, size: 11, depthTest: false, color: 0xff00ff}));
      this.marker.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3), 3));
      this.marker.visible = false;
      this.marker.frustumCulled = false;
      this.scene.add(this.marker);
      if (data.graph) this.addGraph();
      this.title = document.createElement('span');
      this.title.textContent = data.title;
      byId('titles').appendChild(this.title);
    }

    addGraph() {
      this.graph = new THREE.Group();
      this.graph.visible = false;
      const motion = this.surface.motion;
      if (data.graph && motion) {
        this.nodePosition = new THREE.BufferAttribute(new Float32Array(motion.nodes.length / 16 * 3), 3);
        const edges = new THREE.BufferGeometry();
        edges.setAttribute('position', this.nodePosition);
        edges.setIndex(new THREE.BufferAttribute(numbersOf(data.graph.edges), 1));
        this.graphLines = new THREE.LineSegments(edges, new THREE.LineBasicMaterial(
            {color: 0x888888}));
        this.graphLines.frustumCulled = false;
        this.graph.add(this.graphLines);
        const kinds = numbersOf(data.graph.kinds);
        [[1, 0x0072b2, 9], [0, 0xe69f00, 8], [2, 0x888888, 6], [3, 0x3f7fbf, 8]].forEach(([kind, color, size]) => {
          const index = [];
          kinds.forEach((k, j) => { if (k === kind) index.push(j); });
          if (index.length === 0) return;
          const nodes = new THREE.BufferGeometry();
          nodes.setAttribute('position', this.nodePosition);
          nodes.setIndex(index);
          const dots = new THREE.Points(nodes, new THREE.PointsMaterial(
              {...round, color, size}));
          dots.frustumCulled = false;
          this.graph.add(dots);
        });
        this.scene.add(this.graph);
      }
      this.landmarks = new THREE.Group();
      this.landmarkLabels = [];
      if (data.landmarks.length > 0) {
        const lines = new THREE.BufferGeometry();
        this.landmarkPosition =
            new THREE.BufferAttribute(new Float32Array(6 * data.landmarks.length), 3);
        lines.setAttribute('position', this.landmarkPosition);
        for (const object of [
          new THREE.LineSegments(lines, new THREE.LineBasicMaterial({color: 0xd55e00, depthTest: false})),
          new THREE.Points(lines, new THREE.PointsMaterial(
              {...round, color: 0xd55e00, size: 9, depthTest: false}))]) {
          object.frustumCulled = false;
          this.landmarks.add(object);
        }
        this.scene.add(this.landmarks);
        for (const landmark of data.landmarks) {
          const label = document.createElement('span');
          label.className = 'landmark';
          label.textContent = landmark.name;
          byId('titles').appendChild(label);
          this.landmarkLabels.push(label);
        }
      }
    }

    at() { return this.data.at < 0 ? state.way : this.data.at; }

    move() {
      this.places = this.surface.placesAt(this.at());
      this.position.array.set(toView(this.places));
      this.position.needsUpdate = true;
      if (this.hasFaces) this.geometry.computeVertexNormals();
      this.geometry.computeBoundingSphere();
      if (this.nodePosition) {
        this.nodePosition.array.set(toView(this.surface.motion.nodePlaces(this.at())));
        this.nodePosition.needsUpdate = true;
      }
      if (this.landmarkPosition) {
        data.landmarks.forEach((landmark, i) => {
          const place = this.places.subarray(3 * landmark.point, 3 * landmark.point + 3);
          this.landmarkPosition.array.set(toView([...place, ...landmark.wanted]), 6 * i);
        });
        this.landmarkPosition.needsUpdate = true;
      }
      this.mark();
    }

    paint() {
      const field = this.data.colored && this.surface.field(state.field);
      const out = this.color.array;
      const over = isOver();
      if (!field || (over && this.data.surface !== 0)) {
        const plain = cssColor(this.data.surface === 0 ? '--surface' : '--other');
        for (let i = 0; i < out.length; i += 3) {
          out[i] = plain.r; out[i + 1] = plain.g; out[i + 2] = plain.b;
        }
      } else {
        const table = colors[field.scale];
        const width = state.high - state.low;
        for (let i = 0; i < field.values.length; ++i) {
          const value = field.values[i];
          const part = width > 0 ? clamp((value - state.low) / width) : (value > state.high ? 1 : 0);
          const at = Number.isNaN(value) ? -1 : 3 * Math.round(255 * part);
          for (let c = 0; c < 3; ++c) {
            out[3 * i + c] = (at < 0 ? data.colors.unknown[c] : table[at + c]) / 255;
          }
        }
      }
      this.color.needsUpdate = true;
      const isClear = over && this.data.surface !== 0;
      this.material.transparent = !!isClear;
      this.material.opacity = isClear ? 0.4 : 1;
      this.material.depthWrite = !isClear;
      this.material.needsUpdate = true;
    }

    mark() {
      const chosen = state.picked && state.picked.surface === this.data.surface;
      this.marker.visible = !!chosen;
      if (!chosen) return;
      const i = 3 * state.picked.point;
      this.marker.geometry.attributes.position.array.set(this.position.array.subarray(i, i + 3));
      this.marker.geometry.attributes.position.needsUpdate = true;
    }
  }

  // ---- State and controls ------------------------------------------------------------------------

  const state = {field: data.field, way: 1, low: 0, high: 1, picked: null};
  const isOver = () => byId('layout') !== null && byId('layout').value === 'over';
  const panels = data.panels.map((panel, i) => new Panel(panel, i));
  const shownPanels = () => isOver() ? panels.filter((panel) => panel.data.at < 0 ||
      panel.data.surface !== 0 || !panels.some((other) => other.data.at < 0)) : panels;

  const camera = new THREE.PerspectiveCamera(30, 1, 0.01, 100);
  const wakeFirst = (event) => {
    // A finger that passes over the view scrolls the page until the view has been touched.
    if (document.activeElement !== canvas) event.stopImmediatePropagation();
  };
  canvas.addEventListener('touchstart', wakeFirst);
  canvas.addEventListener('touchmove', wakeFirst);
  camera.up.set(...data.camera.up);
  const controls = new THREE.OrbitControls(camera, canvas);
  controls.enableKeys = false;
  controls.enableZoom = false;
  canvas.addEventListener('focus', () => { controls.enableZoom = true; });
  canvas.addEventListener('blur', () => { controls.enableZoom = false; });
  controls.addEventListener('change', () => draw());

  function resetView() {
    controls.target.set(0, 0, 0);
    camera.position.set(...data.camera.from).multiplyScalar(1.02 / Math.sin(Math.PI / 12));
    // A tall panel must show as much as a wide one.
    if (camera.aspect < 1) camera.position.divideScalar(camera.aspect);
    controls.update();
    draw();
  }

  // ---- Drawing -----------------------------------------------------------------------------------

  // Returns the boxes of the panels in CSS pixels from the upper left.
  function boxes() {
    const shown = shownPanels();
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (isOver()) return shown.map(() => ({x: 0, y: 0, width, height}));
    const columns = width < 640 ? 1 : Math.min(shown.length, 3);
    const rows = Math.ceil(shown.length / columns);
    return shown.map((panel, i) => ({
      x: (i % columns) * width / columns, y: Math.floor(i / columns) * height / rows,
      width: width / columns, height: height / rows}));
  }

  function resize() {
    const shown = isOver() ? 1 : panels.length;
    const isNarrow = canvas.clientWidth < 640;
    const columns = isNarrow ? 1 : Math.min(shown, 3);
    const rows = Math.ceil(shown / columns);
    const each = Math.min(560, Math.max(220, canvas.clientWidth / columns * (isNarrow ? 0.7 : 0.95)));
    canvas.style.height = Math.round(each * rows) + 'px';
    renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
    const box = boxes()[0];
    const aspect = box.width / box.height;
    if (camera.aspect >= 1 !== aspect >= 1) {
      const ratio = Math.min(1, camera.aspect) / Math.min(1, aspect);
      camera.position.sub(controls.target).multiplyScalar(ratio).add(controls.target);
    }
    camera.aspect = aspect;
    camera.updateProjectionMatrix();
    draw();
  }

  let isWaiting = false;
  function draw() {
    if (isWaiting) return;
    isWaiting = true;
    requestAnimationFrame(drawNow);
  }

  function drawNow() {
    isWaiting = false;
    const all = boxes(), shown = shownPanels();
    const height = canvas.clientHeight;
    renderer.setScissorTest(true);
    renderer.setScissor(0, 0, canvas.clientWidth, height);
    renderer.setClearColor(cssColor('--stage'));
    renderer.clear();
    for (const panel of panels) panel.title.hidden = true;
    const order = shown.map((panel, i) => [panel, all[i]]);
    order.sort((a, b) => a[0].material.transparent - b[0].material.transparent);
    for (const [panel, box] of order) {
      const bottom = height - box.y - box.height;
      renderer.setViewport(box.x, bottom, box.width, box.height);
      renderer.setScissor(box.x, bottom, box.width, box.height);
      panel.light.position.copy(camera.position);
      panel.light.target.position.copy(controls.target);
      renderer.render(panel.scene, camera);
      placeLabels(panel, box);
    }
  }

  function placeLabels(panel, box) {
    panel.title.hidden = isOver() && panel !== shownPanels()[0];
    panel.title.textContent = isOver() ? shownPanels().map((p) => p.data.title).join(' over ')
                                       : panel.data.title;
    panel.title.style.left = box.x + 8 + 'px';
    panel.title.style.top = box.y + 6 + 'px';
    (panel.landmarkLabels || []).forEach((label, i) => {
      label.hidden = !panel.landmarks.visible;
      const at = new THREE.Vector3().fromArray(panel.landmarkPosition.array, 6 * i + 3).project(camera);
      label.style.left = box.x + (at.x + 1) / 2 * box.width + (at.x > 0.4 ? -6 : 6) + 'px';
      label.style.transform = at.x > 0.4 ? 'translateX(-100%)' : 'none';
      label.style.top = box.y + (1 - at.y) / 2 * box.height - 8 + 'px';
      if (Math.abs(at.x) > 0.98 || Math.abs(at.y) > 0.98) label.hidden = true;
    });
  }

  // ---- Fields and legend -------------------------------------------------------------------------

  const findField = (key) => surfaces.map((surface) => surface.field(key)).find((field) => field);

  function chooseField(key) {
    const field = findField(key);
    state.field = field ? key : '';
    byId('field').value = state.field;
    byId('legend').hidden = !field;
    if (field) {
      state.low = field.low;
      state.high = field.high;
      byId('low').value = short(field.low);
      byId('high').value = short(field.high);
      byId('legendName').textContent = field.name + ' [' + field.unit + ']';
      byId('legendRange').textContent =
          'all values: ' + short(field.min) + ' to ' + short(field.max);
      const bar = byId('bar').getContext('2d');
      const pixels = bar.createImageData(256, 1);
      for (let i = 0; i < 256; ++i) {
        for (let c = 0; c < 3; ++c) pixels.data[4 * i + c] = colors[field.scale][3 * i + c];
        pixels.data[4 * i + 3] = 255;
      }
      bar.putImageData(pixels, 0, 0);
    }
    paintAll();
  }

  function paintAll() {
    for (const panel of panels) panel.paint();
    draw();
  }

  function setWay(way) {
    state.way = clamp(way);
    const slider = byId('way');
    if (slider) {
      slider.value = Math.round(1000 * state.way);
      const moving = panels.find((panel) => panel.data.at < 0).surface.motion;
      const parts = moving.partsAt(state.way);
      byId('wayText').value = (moving.share > 0 ? 'placed ' + Math.round(100 * parts.placed) + ' %, '
                                                : '') + 'bent ' + Math.round(100 * parts.bent) + ' %';
      slider.setAttribute('aria-valuetext', byId('wayText').value);
    }
    for (const panel of panels) if (panel.data.at < 0) panel.move();
    draw();
  }

  // ---- Figures of a vertex -----------------------------------------------------------------------

  function pick(surface, point) {
    state.picked = {surface, point};
    for (const panel of panels) panel.mark();
    const chosen = surfaces[surface];
    const panel = panels.slice().reverse().find((p) => p.data.surface === surface);
    const place = Array.from(panel.places.subarray(3 * point, 3 * point + 3), short).join(', ');
    const figures = chosen.fields.map((field) => field.name + ': ' + short(field.values[point]) +
        (Number.isNaN(field.values[point]) ? '' : ' ' + field.unit));
    byId('row').value = chosen.rows[point];
    byId('pickSurface').value = String(surface);
    byId('values').value = 'Vertex ' + chosen.rows[point] + ' of ' + chosen.name + ' at (' + place +
        '). ' + figures.join('; ');
    draw();
  }

  // Picks the vertex at a place of the canvas in CSS pixels. Returns whether there is one.
  function pickAt(x, y) {
    const shown = shownPanels(), all = boxes();
    const caster = new THREE.Raycaster();
    camera.updateMatrixWorld();
    let best = null;
    shown.forEach((panel, i) => {
      const box = all[i];
      if (x < box.x || y < box.y || x >= box.x + box.width || y >= box.y + box.height) return;
      caster.setFromCamera({x: 2 * (x - box.x) / box.width - 1, y: 1 - 2 * (y - box.y) / box.height},
                           camera);
      caster.params.Points.threshold = 2 / Math.sqrt(panel.surface.count);
      const hit = caster.intersectObject(panel.body)[0];
      if (hit && (!best || hit.distance < best.hit.distance)) best = {hit, panel};
    });
    if (!best) return false;
    let point = best.hit.index;
    if (best.hit.face) {
      const at = best.panel.position.array;
      const gap = (v) => Math.hypot(at[3 * v] - best.hit.point.x, at[3 * v + 1] - best.hit.point.y,
                                    at[3 * v + 2] - best.hit.point.z);
      point = [best.hit.face.a, best.hit.face.b, best.hit.face.c].sort((a, b) => gap(a) - gap(b))[0];
    }
    pick(best.panel.data.surface, point);
    return true;
  }

  // ---- Events ------------------------------------------------------------------------------------

  let pressed = null;
  canvas.addEventListener('mousedown', (event) => { pressed = [event.clientX, event.clientY]; });
  canvas.addEventListener('click', (event) => {
    if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    const box = canvas.getBoundingClientRect();
    pickAt(event.clientX - box.left, event.clientY - box.top);
    canvas.focus({preventScroll: true});
  });

  canvas.addEventListener('keydown', (event) => {
    const offset = camera.position.clone().sub(controls.target);
    const right = new THREE.Vector3().crossVectors(camera.up, offset).normalize();
    const turn = Math.PI / 24;
    const actions = {
      ArrowLeft: () => offset.applyAxisAngle(camera.up.clone().normalize(), -turn),
      ArrowRight: () => offset.applyAxisAngle(camera.up.clone().normalize(), turn),
      ArrowUp: () => { if (offset.angleTo(camera.up) > turn) offset.applyAxisAngle(right, -turn); },
      ArrowDown: () => {
        if (Math.PI - offset.angleTo(camera.up) > turn) offset.applyAxisAngle(right, turn);
      },
      '+': () => offset.multiplyScalar(1 / 1.1),
      '=': () => offset.multiplyScalar(1 / 1.1),
      '-': () => offset.multiplyScalar(1.1)};
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === 'Home') {
      resetView();
    } else if (actions[event.key]) {
      actions[event.key]();
      camera.position.copy(controls.target).add(offset);
      controls.update();
      draw();
    } else {
      return;
    }
    event.preventDefault();
  });

  let playing = 0;
  function play() {
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (still) return setWay(state.way < 1 ? 1 : 0);
    const number = ++playing;
    const start = performance.now();
    const step = (now) => {
      if (number !== playing) return;
      setWay((now - start) / 3000);
      if (state.way < 1) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  const on = (id, event, action) => { if (byId(id)) byId(id).addEventListener(event, action); };
  on('field', 'change', () => chooseField(byId('field').value));
  on('layout', 'change', () => { resize(); paintAll(); });
  on('way', 'input', () => { ++playing; setWay(byId('way').value / 1000); });
  on('play', 'click', play);
  on('reset', 'click', resetView);
  on('edges', 'change', () => {
    for (const panel of panels) if (panel.wire) panel.wire.visible = byId('edges').checked;
    draw();
  });
  on('graph', 'change', () => {
    for (const panel of panels) if (panel.graph) panel.graph.visible = byId('graph').checked;
    paintAll();
  });
  on('landmarks', 'change', () => {
    for (const panel of panels) if (panel.landmarks) panel.landmarks.visible = byId('landmarks').checked;
    draw();
  });
  for (const id of ['low', 'high']) {
    on(id, 'change', () => {
      const value = Number(byId(id).value);
      if (Number.isFinite(value)) state[id] = value;
      paintAll();
    });
  }
  surfaces.forEach((surface, i) => byId('pickSurface').add(new Option(surface.name, String(i))));
  const pickRow = () => {
    const surface = Number(byId('pickSurface').value);
    if (byId('row').value === '') return;
    const point = surfaces[surface].pointOfRow(Number(byId('row').value));
    if (point >= 0) return pick(surface, point);
    byId('values').value = 'Vertex ' + byId('row').value + ' of ' + surfaces[surface].name +
        ' is not among those that are shown.';
  };
  on('row', 'change', pickRow);
  on('pickSurface', 'change', pickRow);
  window.addEventListener('resize', resize);
  matchMedia('(prefers-color-scheme: dark)').addListener(() => paintAll());

  for (const panel of panels) panel.move();
  if (byId('way')) setWay(1);
  resize();
  resetView();
  chooseField(data.field);

  // For tests, and for the console of a browser.
  Object.assign(page, {
    ready: true, state, panels, setWay, chooseField, pick, pickAt, boxes, resetView,
    // The places of all points of a panel, in the unit of the files.
    places: (panel) => Array.from(panels[panel].places),
    // Where a point of a panel is on the canvas, in CSS pixels.
    pixelOf: (panel, point) => {
      const box = boxes()[shownPanels().indexOf(panels[panel])];
      camera.updateMatrixWorld();
      const at = new THREE.Vector3().fromArray(panels[panel].position.array, 3 * point).project(camera);
      return [box.x + (at.x + 1) / 2 * box.width, box.y + (1 - at.y) / 2 * box.height];
    },
    // The pixels of the canvas, after it has been drawn.
    pixels: () => {
      drawNow();
      const gl = renderer.getContext();
      const out = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
      gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, out);
      return out;
    }
  });
})();
