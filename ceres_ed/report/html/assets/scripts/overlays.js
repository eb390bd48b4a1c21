// What a panel draws with its surface: the graph, landmarks, the path of the camera, and tracks.

function addOverlays(panel) {
  const {data} = panel.view;
  if (data.graph && panel.surface.motion) panel.overlays.push(new GraphOverlay(panel));
  if (data.landmarks.length > 0) panel.overlays.push(new LandmarkOverlay(panel));
  if (data.timeline) panel.overlays.push(new PathOverlay(panel));
}

// Returns a geometry of `count` points that move.
function movingPoints(count) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  return geometry;
}

// Adds an object that is never left out, for its bounds change.
function addTo(group, object) {
  object.frustumCulled = false;
  group.add(object);
  return object;
}

class GraphOverlay {
  constructor(panel) {
    const {data} = panel.view;
    const group = panel.graph = new THREE.Group();
    group.visible = false;
    const edges = movingPoints(panel.surface.motion.nodes.length / 16);
    this.position = edges.getAttribute('position');
    edges.setIndex(new THREE.BufferAttribute(numbersOf(data.graph.edges), 1));
    addTo(group, new THREE.LineSegments(edges, new THREE.LineBasicMaterial({color: 0x888888})));
    const kinds = numbersOf(data.graph.kinds);
    for (const [kind, color, size] of
         [[1, 0x0072b2, 9], [0, 0xe69f00, 8], [2, 0x888888, 6], [3, 0x3f7fbf, 8]]) {
      const index = [];
      kinds.forEach((k, j) => { if (k === kind) index.push(j); });
      if (index.length === 0) continue;
      const nodes = new THREE.BufferGeometry();
      nodes.setAttribute('position', this.position);
      nodes.setIndex(index);
      addTo(group, new THREE.Points(nodes, dotMaterial({color, size})));
    }
    panel.scene.add(group);
  }

  move(panel) {
    this.position.array.set(panel.view.toView(panel.surface.motion.nodePlaces(panel.at())));
    this.position.needsUpdate = true;
  }
}

class LandmarkOverlay {
  constructor(panel) {
    const {data} = panel.view;
    panel.landmarks = new THREE.Group();
    const lines = movingPoints(2 * data.landmarks.length);
    this.position = lines.getAttribute('position');
    addTo(panel.landmarks, new THREE.LineSegments(
        lines, new THREE.LineBasicMaterial({color: 0xd55e00, depthTest: false})));
    addTo(panel.landmarks, new THREE.Points(
        lines, dotMaterial({color: 0xd55e00, size: 9, depthTest: false})));
    panel.scene.add(panel.landmarks);
    this.labels = data.landmarks.map((landmark) => {
      const label = document.createElement('span');
      label.className = 'landmark';
      label.textContent = landmark.name;
      byId('titles').appendChild(label);
      return label;
    });
  }

  move(panel) {
    panel.view.data.landmarks.forEach((landmark, i) => {
      const place = panel.places.subarray(3 * landmark.point, 3 * landmark.point + 3);
      this.position.array.set(panel.view.toView([...place, ...landmark.wanted]), 6 * i);
    });
    this.position.needsUpdate = true;
  }

  placeLabels(panel, box) {
    this.labels.forEach((label, i) => {
      label.hidden = !panel.landmarks.visible;
      const at = new THREE.Vector3().fromArray(this.position.array, 6 * i + 3)
          .project(panel.view.camera);
      label.style.left = box.x + (at.x + 1) / 2 * box.width + (at.x > 0.4 ? -6 : 6) + 'px';
      label.style.transform = at.x > 0.4 ? 'translateX(-100%)' : 'none';
      label.style.top = box.y + (1 - at.y) / 2 * box.height - 8 + 'px';
      if (Math.abs(at.x) > 0.98 || Math.abs(at.y) > 0.98) label.hidden = true;
    });
  }
}

// The path of the camera, its pyramid of vision now, and the tracks of points that were chosen.
class PathOverlay {
  constructor(panel) {
    const {view} = panel;
    this.timeline = view.timeline;
    const group = panel.path = new THREE.Group();
    const all = [];
    this.timeline.poses.forEach((pose) => { if (pose) all.push(...pose.center); });
    const path = movingPoints(all.length / 3);
    path.getAttribute('position').array.set(view.toView(all));
    addTo(group, new THREE.Line(path, new THREE.LineBasicMaterial({color: 0x3f7fbf})));
    // A pyramid: four edges from the centre, and its four sides.
    this.pyramid = movingPoints(5);
    this.pyramid.setIndex([0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1]);
    addTo(group, new THREE.LineSegments(
        this.pyramid, new THREE.LineBasicMaterial({color: 0xd55e00})));
    this.tracks = this.timeline.tracks.map((track) => {
      const line = movingPoints(track.places.length / 3);
      const object = addTo(group, new THREE.Line(
          line, new THREE.LineBasicMaterial({color: 0xcc3399, depthTest: false})));
      return {track, line, object};
    });
    this.dots = movingPoints(this.tracks.length);
    if (this.tracks.length > 0) {
      addTo(group, new THREE.Points(
          this.dots, dotMaterial({color: 0xcc3399, size: 8, depthTest: false})));
    }
    panel.scene.add(group);
  }

  move(panel) {
    const {view} = panel;
    const moment = this.timeline.momentAt(panel.at());
    const pose = this.timeline.poseOf(moment);
    if (pose) {
      const c = this.timeline.camera, size = 0.22 * view.radius;
      const corner = (u, v) => pose.act([(u - c.cx) / c.fx * size, (v - c.cy) / c.fy * size, size]);
      const w = c.width, h = c.height;
      const corners = [pose.center, corner(0, 0), corner(w, 0), corner(w, h), corner(0, h)];
      this.set(this.pyramid, view.toView([].concat(...corners)));
    }
    const dots = [];
    for (const {track, line, object} of this.tracks) {
      this.set(line, view.toView(track.places));
      // The way up to now.
      const until = track.moments.filter((m) => m <= moment).length;
      line.setDrawRange(0, until);
      object.visible = until > 1;
      if (until > 0) dots.push(...track.places.slice(3 * until - 3, 3 * until));
    }
    this.set(this.dots, view.toView(dots));
    this.dots.setDrawRange(0, dots.length / 3);
  }

  set(geometry, numbers) {
    const position = geometry.getAttribute('position');
    position.array.set(numbers);
    position.needsUpdate = true;
  }
}
