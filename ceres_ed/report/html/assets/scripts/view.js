// The view: panels of surfaces with one camera, and what of them is shown.

class View {
  constructor(data, renderer) {
    this.data = data;
    this.renderer = renderer;
    this.canvas = renderer.domElement;
    this.renderer.autoClear = false;
    this.renderer.setPixelRatio(window.devicePixelRatio || 1);
    this.surfaces = data.surfaces.map((surface) => new SurfaceData(surface));
    this.radius = data.radius;
    this.colors = {magnitude: bytesOf(data.colors.magnitude), signed: bytesOf(data.colors.signed)};
    this.timeline = data.timeline ? new Timeline(data.timeline) : null;
    // The way of the surfaces is 0 at its beginning and 1 at its end.
    this.state = {field: data.field, way: 1, low: 0, high: 1, picked: null};
    this.panels = data.panels.map((panel, i) => new Panel(this, panel, i));
    this.isWaiting = false;
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.01, 100);
    this.camera.up.set(...data.camera.up);
    this.makeControls();
  }

  makeControls() {
    const {canvas} = this;
    const wakeFirst = (event) => {
      // A finger that passes over the view scrolls the page until the view has been touched.
      if (document.activeElement !== canvas) event.stopImmediatePropagation();
    };
    canvas.addEventListener('touchstart', wakeFirst);
    canvas.addEventListener('touchmove', wakeFirst);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;
    this.controls.enableZoom = false;
    canvas.addEventListener('focus', () => { this.controls.enableZoom = true; });
    canvas.addEventListener('blur', () => { this.controls.enableZoom = false; });
    this.controls.addEventListener('change', () => this.draw());
  }

  isOver() { return byId('layout') !== null && byId('layout').value === 'over'; }

  shownPanels() {
    if (!this.isOver()) return this.panels;
    return this.panels.filter((panel) => panel.data.at < 0 || panel.data.surface !== 0 ||
        !this.panels.some((other) => other.data.at < 0));
  }

  toView(places) {
    const out = new Float32Array(places.length);
    for (let i = 0; i < places.length; ++i) {
      out[i] = (places[i] - this.data.center[i % 3]) / this.radius;
    }
    return out;
  }

  resetView() {
    const {camera, controls} = this;
    controls.target.set(0, 0, 0);
    camera.position.set(...this.data.camera.from).multiplyScalar(1.02 / Math.sin(Math.PI / 12));
    // A tall panel must show as much as a wide one.
    if (camera.aspect < 1) camera.position.divideScalar(camera.aspect);
    controls.update();
    this.draw();
  }

  // Returns the boxes of the panels in CSS pixels from the upper left.
  boxes() {
    const shown = this.shownPanels();
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (this.isOver()) return shown.map(() => ({x: 0, y: 0, width, height}));
    const columns = width < 640 ? 1 : Math.min(shown.length, 3);
    const rows = Math.ceil(shown.length / columns);
    return shown.map((panel, i) => ({
      x: (i % columns) * width / columns, y: Math.floor(i / columns) * height / rows,
      width: width / columns, height: height / rows}));
  }

  resize() {
    const {canvas, camera, controls} = this;
    const shown = this.isOver() ? 1 : this.panels.length;
    const isNarrow = canvas.clientWidth < 640;
    const columns = isNarrow ? 1 : Math.min(shown, 3);
    const rows = Math.ceil(shown / columns);
    const each = Math.min(560, Math.max(220, canvas.clientWidth / columns * (isNarrow || this.timeline ? 0.75 : 0.95)));
    canvas.style.height = Math.round(each * rows) + 'px';
    this.renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
    const box = this.boxes()[0];
    const aspect = box.width / box.height;
    if (camera.aspect >= 1 !== aspect >= 1) {
      const ratio = Math.min(1, camera.aspect) / Math.min(1, aspect);
      camera.position.sub(controls.target).multiplyScalar(ratio).add(controls.target);
    }
    camera.aspect = aspect;
    camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    this.isWaiting = false;
    const {renderer, camera, canvas} = this;
    const all = this.boxes(), shown = this.shownPanels();
    const height = canvas.clientHeight;
    renderer.setScissorTest(true);
    renderer.setScissor(0, 0, canvas.clientWidth, height);
    renderer.setClearColor(cssColor('--stage'));
    renderer.clear();
    for (const panel of this.panels) panel.title.hidden = true;
    const order = shown.map((panel, i) => [panel, all[i]]);
    order.sort((a, b) => a[0].material.transparent - b[0].material.transparent);
    for (const [panel, box] of order) {
      const bottom = height - box.y - box.height;
      renderer.setViewport(box.x, bottom, box.width, box.height);
      renderer.setScissor(box.x, bottom, box.width, box.height);
      panel.light.position.copy(camera.position);
      panel.light.target.position.copy(this.controls.target);
      renderer.render(panel.scene, camera);
      this.placeLabels(panel, box);
    }
  }

  placeLabels(panel, box) {
    const shown = this.shownPanels();
    panel.title.hidden = this.isOver() && panel !== shown[0];
    panel.title.textContent =
        this.isOver() ? shown.map((p) => p.data.title).join(' over ') : panel.data.title;
    panel.title.style.left = box.x + 8 + 'px';
    panel.title.style.top = box.y + 6 + 'px';
    for (const overlay of panel.overlays) if (overlay.placeLabels) overlay.placeLabels(panel, box);
  }

  paintAll() {
    for (const panel of this.panels) panel.paint();
    this.draw();
  }

  setWay(way) {
    this.state.way = clamp(way);
    if (this.timeline) {
      this.timeline.show(this.state.way);
    } else {
      this.showWay();
    }
    for (const panel of this.panels) if (panel.data.at < 0) panel.move();
    if (this.state.picked) tellFigures(this);
    this.draw();
  }

  // Says how far from source to result the surface is.
  showWay() {
    const slider = byId('way');
    if (!slider) return;
    slider.value = Math.round(1000 * this.state.way);
    const {motion} = this.panels.find((panel) => panel.data.at < 0).surface;
    const parts = motion.partsAt(this.state.way);
    byId('wayText').value = (motion.share > 0 ? 'placed ' + Math.round(100 * parts.placed) + ' %, '
                                              : '') + 'bent ' + Math.round(100 * parts.bent) + ' %';
    slider.setAttribute('aria-valuetext', byId('wayText').value);
  }
}
