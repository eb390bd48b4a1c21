// Keys, buttons and choices of the view.

function turnByKey(view, event) {
  const {camera, controls} = view;
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
    view.resetView();
  } else if (actions[event.key]) {
    actions[event.key]();
    camera.position.copy(controls.target).add(offset);
    controls.update();
    view.draw();
  } else {
    return;
  }
  event.preventDefault();
}

// Ends a motion that plays.
function stopPlaying(view) { view.playing = (view.playing || 0) + 1; }

function play(view) {
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  if (still) return view.setWay(view.state.way < 1 ? 1 : 0);
  stopPlaying(view);
  const number = view.playing;
  const start = performance.now();
  // A sequence takes a tenth of a second for each moment.
  const duration = view.timeline ? 100 * view.timeline.moments.length : 3000;
  const step = (now) => {
    if (number !== view.playing) return;
    view.setWay((now - start) / duration);
    if (view.state.way < 1) requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function addControls(view) {
  const {canvas, panels} = view;
  canvas.addEventListener('keydown', (event) => turnByKey(view, event));
  on('field', 'change', () => chooseField(view, byId('field').value));
  on('layout', 'change', () => { view.resize(); view.paintAll(); });
  on('way', 'input', () => { stopPlaying(view); view.setWay(byId('way').value / 1000); });
  on('play', 'click', () => play(view));
  on('reset', 'click', () => view.resetView());
  on('edges', 'change', () => {
    for (const panel of panels) if (panel.wire) panel.wire.visible = byId('edges').checked;
    view.draw();
  });
  on('graph', 'change', () => {
    for (const panel of panels) if (panel.graph) panel.graph.visible = byId('graph').checked;
    view.paintAll();
  });
  on('landmarks', 'change', () => {
    for (const panel of panels) {
      if (panel.landmarks) panel.landmarks.visible = byId('landmarks').checked;
    }
    view.draw();
  });
  window.addEventListener('resize', () => view.resize());
  matchMedia('(prefers-color-scheme: dark)').addListener(() => view.paintAll());
}
