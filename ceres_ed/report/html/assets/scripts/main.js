// Starts the view of a page that has one. Where there is no WebGL the page keeps its picture.

function startView() {
  const element = byId('scene');
  if (!element) return;
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer(
        {canvas: byId('view'), antialias: true, preserveDrawingBuffer: true});
  } catch (error) {
    byId('stillText').textContent = 'This browser has no WebGL, so there is a picture only.';
    return;
  }
  const view = new View(JSON.parse(element.textContent), renderer);
  byId('viewer').hidden = false;
  byId('still').hidden = true;
  addControls(view);
  addRangeInputs(view);
  addPicking(view);
  if (view.timeline) addTimeline(view);
  for (const panel of view.panels) panel.move();
  if (byId('way') || view.timeline) view.setWay(1);
  view.resize();
  view.resetView();
  chooseField(view, view.data.field);

  // For tests, and for the console of a browser.
  Object.assign(page, {
    ready: true, view, state: view.state, panels: view.panels, surfaces: view.surfaces,
    setWay: (way) => view.setWay(way),
    chooseField: (key) => chooseField(view, key),
    pick: (surface, point) => pick(view, surface, point),
    pickAt: (x, y) => pickAt(view, x, y),
    boxes: () => view.boxes(),
    resetView: () => view.resetView(),
    // The places of all points of a panel, in the unit of the files.
    places: (panel) => Array.from(view.panels[panel].places),
    // Where a point of a panel is on the canvas, in CSS pixels.
    pixelOf: (panel, point) => {
      const box = view.boxes()[view.shownPanels().indexOf(view.panels[panel])];
      view.camera.updateMatrixWorld();
      const at = new THREE.Vector3().fromArray(view.panels[panel].position.array, 3 * point)
          .project(view.camera);
      return [box.x + (at.x + 1) / 2 * box.width, box.y + (1 - at.y) / 2 * box.height];
    },
    // The pixels of the canvas, after it has been drawn.
    pixels: () => {
      view.drawNow();
      const gl = view.renderer.getContext();
      const out = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
      gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA,
                    gl.UNSIGNED_BYTE, out);
      return out;
    }
  });
}

startView();
