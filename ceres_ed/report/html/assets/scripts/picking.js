// The figures of one point, which is clicked or named by its number.

function pick(view, surface, point) {
  view.state.picked = {surface, point};
  for (const panel of view.panels) panel.mark();
  byId('row').value = view.surfaces[surface].rows[point];
  byId('pickSurface').value = String(surface);
  tellFigures(view);
  view.draw();
}

// Writes the figures of the point that is picked.
function tellFigures(view) {
  const {surface, point} = view.state.picked;
  const chosen = view.surfaces[surface];
  const panel = view.panels.slice().reverse().find((p) => p.data.surface === surface);
  const what = data => 'Vertex ' + chosen.rows[point] + ' of ' + chosen.name + data;
  if (!chosen.isThere(point, panel.at())) {
    byId('values').value = what(' is not in the map in this frame.');
    return;
  }
  const place = Array.from(panel.places.subarray(3 * point, 3 * point + 3), short).join(', ');
  const figures = chosen.fields.map((field) => {
    const value = chosen.valuesAt(field, panel.at())[point];
    return field.name + ': ' + short(value) + (Number.isNaN(value) ? '' : ' ' + field.unit);
  });
  byId('values').value = what(' at (' + place + '). ') + figures.join('; ');
}

// Picks the vertex at a place of the canvas in CSS pixels. Returns whether there is one.
function pickAt(view, x, y) {
  const shown = view.shownPanels(), all = view.boxes();
  const caster = new THREE.Raycaster();
  view.camera.updateMatrixWorld();
  let best = null;
  shown.forEach((panel, i) => {
    const box = all[i];
    if (x < box.x || y < box.y || x >= box.x + box.width || y >= box.y + box.height) return;
    caster.setFromCamera({x: 2 * (x - box.x) / box.width - 1, y: 1 - 2 * (y - box.y) / box.height},
                         view.camera);
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
  pick(view, best.panel.data.surface, point);
  return true;
}

// Takes clicks, and numbers of vertices.
function addPicking(view) {
  const {canvas, surfaces} = view;
  let pressed = null;
  canvas.addEventListener('mousedown', (event) => { pressed = [event.clientX, event.clientY]; });
  canvas.addEventListener('click', (event) => {
    if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    const box = canvas.getBoundingClientRect();
    pickAt(view, event.clientX - box.left, event.clientY - box.top);
    canvas.focus({preventScroll: true});
  });
  surfaces.forEach((surface, i) => byId('pickSurface').add(new Option(surface.name, String(i))));
  const pickRow = () => {
    const surface = Number(byId('pickSurface').value);
    if (byId('row').value === '') return;
    const point = surfaces[surface].pointOfRow(Number(byId('row').value));
    if (point >= 0) return pick(view, surface, point);
    byId('values').value = 'Vertex ' + byId('row').value + ' of ' + surfaces[surface].name +
        ' is not among those that are shown.';
  };
  on('row', 'change', pickRow);
  on('pickSurface', 'change', pickRow);
}
