// The field that colours show, with the ends of its range.

function chooseField(view, key) {
  const {state} = view;
  const field = view.surfaces.map((surface) => surface.field(key)).find((found) => found);
  const hasColors = key === 'colors' && view.surfaces.some((surface) => surface.colors);
  state.field = field || hasColors ? key : '';
  byId('field').value = state.field;
  byId('legend').hidden = !field;
  if (field) {
    state.low = field.low;
    state.high = field.high;
    byId('low').value = short(field.low);
    byId('high').value = short(field.high);
    byId('legendName').textContent = field.name + ' [' + field.unit + ']';
    byId('legendRange').textContent =
        'all values: ' + short(field.min) + ' to ' + short(field.max) + field.note;
    const bar = byId('bar').getContext('2d');
    const pixels = bar.createImageData(256, 1);
    for (let i = 0; i < 256; ++i) {
      for (let c = 0; c < 3; ++c) pixels.data[4 * i + c] = view.colors[field.scale][3 * i + c];
      pixels.data[4 * i + 3] = 255;
    }
    bar.putImageData(pixels, 0, 0);
  }
  view.paintAll();
}

// Takes the ends of the colours that a user has written.
function addRangeInputs(view) {
  for (const id of ['low', 'high']) {
    on(id, 'change', () => {
      const value = Number(byId(id).value);
      if (Number.isFinite(value)) view.state[id] = value;
      view.paintAll();
    });
  }
}
