// A panel of the view: one surface, drawn with three.js.

const cssColor = (name) =>
    new THREE.Color(getComputedStyle(document.body).getPropertyValue(name).trim());

// Returns the material of round dots, for points that are marked; it may be changed by `more`.
function dotMaterial(more) {
  if (!dotMaterial.map) {
    const dot = document.createElement('canvas');
    dot.width = dot.height = 32;
    const pen = dot.getContext('2d');
    pen.fillStyle = '#fff';
    pen.arc(16, 16, 15, 0, 2 * Math.PI);
    pen.fill();
    dotMaterial.map = new THREE.CanvasTexture(dot);
  }
  return new THREE.PointsMaterial(
      {map: dotMaterial.map, alphaTest: 0.5, sizeAttenuation: false, ...more});
}

// Returns the material of a surface without faces. Points with a normal are darker where the
// surface turns away from the eye.
function cloudMaterial(size) {
  const material = new THREE.PointsMaterial({size, vertexColors: THREE.VertexColors});
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = 'varying float shade;\n' + shader.vertexShader.replace(
        '#include <project_vertex>',
        '#include <project_vertex>\n' +
        'float size_of_normal = length(normal);\n' +
        'shade = size_of_normal > 0.5 ? 0.5 + 0.5 * abs(dot(normalize(normalMatrix * normal), ' +
        'normalize(mvPosition.xyz))) : 1.0;');
    shader.fragmentShader = 'varying float shade;\n' + shader.fragmentShader.replace(
        '#include <color_fragment>', '#include <color_fragment>\ndiffuseColor.rgb *= shade;');
  };
  return material;
}

class Panel {
  constructor(view, data, number) {
    this.view = view;
    this.data = data;
    this.surface = view.surfaces[data.surface];
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
    if (this.hasFaces) this.addFaces(); else this.addPoints();
    this.scene.add(this.body);
    this.marker = new THREE.Points(new THREE.BufferGeometry(),
                                   dotMaterial({size: 11, depthTest: false, color: 0xff00ff}));
    this.marker.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3), 3));
    this.marker.visible = false;
    this.marker.frustumCulled = false;
    this.scene.add(this.marker);
    // What is drawn with the surface and moves with it.
    this.overlays = [];
    if (data.graph) addOverlays(this);
    this.title = document.createElement('span');
    this.title.textContent = data.title;
    byId('titles').appendChild(this.title);
  }

  addFaces() {
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
  }

  addPoints() {
    const normals = this.surface.normals || new Float32Array(3 * this.surface.count);
    this.geometry.setAttribute('normal', new THREE.BufferAttribute(Float32Array.from(normals), 3));
    const {spacing, count} = this.surface;
    // Points that touch; three.js leaves the angle of view out of their size.
    this.material = cloudMaterial(
        spacing > 0 ? 6.5 * spacing / this.view.radius : 4.5 / Math.sqrt(count));
    this.body = new THREE.Points(this.geometry, this.material);
  }

  at() { return this.data.at < 0 ? this.view.state.way : this.data.at; }

  move() {
    this.places = this.surface.placesAt(this.at());
    this.position.array.set(this.view.toView(this.places));
    this.position.needsUpdate = true;
    if (this.surface.moments) {
      this.geometry.setIndex(this.surface.moments.shownAt(this.at()));
      if (this.changesColor()) this.paint();
    }
    if (this.hasFaces) this.geometry.computeVertexNormals();
    this.geometry.computeBoundingSphere();
    for (const overlay of this.overlays) overlay.move(this);
    this.mark();
  }

  // Returns whether the figures that are shown change from moment to moment.
  changesColor() {
    const field = this.data.colored && this.surface.field(this.view.state.field);
    return !!field && field.values.length > this.surface.count;
  }

  paint() {
    const {state, data, colors} = this.view;
    const field = this.data.colored && this.surface.field(state.field);
    const out = this.color.array;
    const over = this.view.isOver();
    if (state.field === 'colors' && this.surface.colors && this.data.colored) {
      for (let i = 0; i < out.length; ++i) out[i] = this.surface.colors[i] / 255;
    } else if (!field || (over && this.data.surface !== 0)) {
      const plain = cssColor(this.data.surface === 0 ? '--surface' : '--other');
      for (let i = 0; i < out.length; i += 3) {
        out[i] = plain.r; out[i + 1] = plain.g; out[i + 2] = plain.b;
      }
    } else {
      const table = colors[field.scale];
      const width = state.high - state.low;
      this.surface.valuesAt(field, this.at()).forEach((value, i) => {
        const part = width > 0 ? clamp((value - state.low) / width) : (value > state.high ? 1 : 0);
        const isHidden = Number.isNaN(value) || (field.hidden && field.hidden[i] !== 0);
        const at = isHidden ? -1 : 3 * Math.round(255 * part);
        for (let c = 0; c < 3; ++c) {
          out[3 * i + c] = (at < 0 ? data.colors.unknown[c] : table[at + c]) / 255;
        }
      });
    }
    this.color.needsUpdate = true;
    const isClear = over && this.data.surface !== 0;
    this.material.transparent = !!isClear;
    this.material.opacity = isClear ? 0.4 : 1;
    this.material.depthWrite = !isClear;
    this.material.needsUpdate = true;
  }

  mark() {
    const {picked} = this.view.state;
    const chosen = picked && picked.surface === this.data.surface &&
        this.surface.isThere(picked.point, this.at());
    this.marker.visible = !!chosen;
    if (!chosen) return;
    const i = 3 * picked.point;
    this.marker.geometry.attributes.position.array.set(this.position.array.subarray(i, i + 3));
    this.marker.geometry.attributes.position.needsUpdate = true;
  }
}
