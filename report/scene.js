// The flight in three dimensions: x east, y north, z up, as in the frame world [m].
function drawing(canvas) {
  THREE.Object3D.DefaultUp.set(0, 0, 1);
  const renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  const scene = new THREE.Scene();
  const span = Math.max(...runs.map(run => run.span));
  const camera = new THREE.PerspectiveCamera(32, 1, 0.02 * span, 2000 * span);
  camera.up.set(0, 0, 1);
  const controls = new THREE.OrbitControls(camera, canvas);
  controls.enableDamping = true;
  controls.dampingFactor = 0.12;
  controls.minDistance = 0.8 * span;
  const sun = new THREE.DirectionalLight(0xffffff, 0.75);
  sun.position.set(1, -0.6, 2);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x777788, 0.75), sun);
  const insects = runs.map((run, i) => insectOf(run, i));
  insects.forEach(insect => scene.add(insect.group));
  const state = {follow: true, pressure: true, apart: several, real: true, t: start};
  let ground = null, changed = true;  // drawn again only then

  const offset = i => state.apart ? (i - (runs.length - 1) / 2) * 3.2 * span : 0;

  function arrange() {
    insects.forEach((insect, i) => insect.group.position.set(offset(i), 0, 0));
    if (ground) scene.remove(ground);
    ground = groundOf(span, runs.map((run, i) => offset(i)));
    scene.add(ground);
    paint();
  }

  // The colours of the page.
  function paint() {
    const dark = isDark(), back = new THREE.Color(dark ? 0x10151b : 0xf3f6f9);
    scene.background = back;
    scene.fog = new THREE.Fog(back.getHex(), 1e6, 2e6);
    insects.forEach(insect => insect.paint());
    changed = true;
    ground.material.color.set(dark ? 0x33404d : 0xc4ced8);
  }

  function middle() {
    const at = new THREE.Vector3();
    insects.forEach(insect => at.add(insect.place()));
    return at.divideScalar(insects.length);
  }

  // The box of all paths and wings at all times.
  function whole() {
    const box = new THREE.Box3();
    insects.forEach((insect, i) => insect.path.forEach(p => box.expandByPoint(p.clone().add(new THREE.Vector3(offset(i), 0, 0)))));
    return box.expandByScalar(1.1 * span);
  }

  const views = {oblique: [0.78, -0.72, 0.42], side: [1, 0, 0.0], front: [0.12, 1, 0.06], above: [0.001, -0.001, 1], whole: [0.93, -0.35, 0.3]};

  function look(name) {
    const direction = new THREE.Vector3(...views[name]).normalize();
    const size = name === "whole" ? whole().getSize(new THREE.Vector3()) : null;
    state.follow = name !== "whole";
    const target = name === "whole" ? whole().getCenter(new THREE.Vector3()) : middle();
    const across = Math.abs(direction.x) > 0.5 || name === "whole" ? 0 : 1;
    const wide = name === "whole" ? Math.hypot(size.x * 0.5, size.y) : (2.8 + (state.apart && across + 0.75 ? 3.2 * (runs.length - 1) : 0)) * span;
    const high = name === "whole" ? size.z : 2.2 * span;
    const tangent = Math.tan(camera.fov * Math.PI / 360);
    const nearer = name !== "whole" && state.apart ? 3.2 * (runs.length - 1) * span * Math.abs(direction.x) : 0;  // those in front
    const distance = Math.max(high / 2 / tangent + nearer, wide / 2 / tangent / camera.aspect);
    controls.target.copy(target);
    camera.position.copy(target).addScaledVector(direction, distance * 1.12);
    controls.update();
    changed = true;
  }

  function show(t) {
    const before = middle();
    state.t = t;
    changed = true;
    insects.forEach(insect => insect.show(t, state));
    if (state.follow) {
      const moved = middle().sub(before);
      camera.position.add(moved);
      controls.target.add(moved);
    }
  }

  function resize() {
    const {clientWidth: w, clientHeight: h} = canvas.parentElement;
    const before = camera.aspect;
    renderer.setSize(w, h, false);
    camera.aspect = w / h;
    camera.updateProjectionMatrix();
    changed = true;
    return before !== camera.aspect;
  }

  resize();
  arrange();
  show(start);
  look("oblique");
  return {
    show, look, arrange, paint, resize, state,
    draw() {
      if (!controls.update() && !changed) return;
      changed = false;
      renderer.render(scene, camera);
    },
  };
}

// Squares below the paths; their side is a round number of metres.
function groundOf(span, offsets) {
  const box = new THREE.Box3();
  runs.forEach((run, k) => {
    const p = run.frames.place;
    for (let i = 0; i < p.length; i += 3) box.expandByPoint(new THREE.Vector3(p[i] + offsets[k], p[i + 1], p[i + 2]));
  });
  const side = roundNumber(1.2 * span);
  const low = [box.min.x - 4 * span, box.min.y - 4 * span].map(v => Math.floor(v / side)), z = box.min.z - 1.6 * span;
  const high = [box.max.x + 4 * span, box.max.y + 4 * span].map(v => Math.ceil(v / side));
  const points = [];
  for (let i = low[0]; i <= high[0]; ++i) points.push(i * side, low[1] * side, z, i * side, high[1] * side, z);
  for (let j = low[1]; j <= high[1]; ++j) points.push(low[0] * side, j * side, z, high[0] * side, j * side, z);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  document.getElementById("squares").textContent = `squares of ${side >= 1 ? side + " m" : +(100 * side).toPrecision(3) + " cm"}`;
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({transparent: true, opacity: 0.8}));
}

function roundNumber(value) {
  const power = 10 ** Math.floor(Math.log10(value)), rest = value / power;
  return (rest < 2 ? 1 : rest < 5 ? 2 : 5) * power;
}

// The frames of the insect, hung on each other as in its URDF, with what is seen in them.
function insectOf(run, number) {
  const group = new THREE.Group(), links = {base_link: new THREE.Group()}, turning = [];
  group.add(links.base_link);
  run.joints.forEach(joint => {
    const frame = new THREE.Group(), turn = new THREE.Group();
    frame.position.set(...joint.xyz);
    frame.rotation.set(...joint.rpy, "ZYX");
    frame.add(turn);
    links[joint.parent].add(frame);
    links[joint.child] = turn;
    if (joint.axis) turning.push({turn, axis: new THREE.Vector3(...joint.axis), column: run.angles.indexOf(joint.name)});
  });
  const bodies = Object.entries(run.solids).map(([link, corners]) => {
    const mesh = solidOf(corners);
    links[link].add(mesh);
    return mesh;
  });
  const wings = Object.entries(run.wings).map(([link, points]) => {
    const wing = wingOf(run, link, points);
    links[link].add(wing.group);
    return wing;
  });
  const places = run.frames.place, path = [];
  for (let i = 0; i < places.length; i += 3) path.push(new THREE.Vector3(places[i], places[i + 1], places[i + 2]));
  const trail = trailOf(path, run.span), real = run.measured && dotsOf(run.measured, run.span);
  if (trail) group.add(trail.done, trail.all);
  if (real) group.add(real);

  return {
    group, path,
    place: () => links.base_link.position.clone().add(group.position),
    paint() {
      const dark = isDark(), colour = several ? colourOf(number) : dark ? "#ff8c42" : "#c8501e";
      if (trail) { trail.done.material.color.set(colour); trail.all.material.color.set(colour); }
      if (real) real.material.color.set(dark ? 0xd5dbe1 : 0x1d2329);
      bodies.forEach(mesh => mesh.material.color.set(several ? colour : dark ? 0x6b6259 : 0x3c342e));
      wings.forEach(wing => wing.edge.material.color.set(several ? colour : dark ? 0xaeb8c2 : 0x20262c));
    },
    show(t, state) {
      const {i, f} = rowAt(run.frames.t, t), n = run.angles.length, a = run.frames.angles, q = run.frames.attitude;
      const next = Math.min(i + 1, path.length - 1);
      links.base_link.position.lerpVectors(path[i], path[next], f);
      links.base_link.quaternion.fromArray(q, 4 * i).slerp(new THREE.Quaternion().fromArray(q, 4 * next), f);
      turning.forEach(({turn, axis, column}) => {
        const now = a[n * i + column];
        turn.quaternion.setFromAxisAngle(axis, now + f * (a[n * next + column] - now));
      });
      wings.forEach(wing => wing.show(t, state.pressure));
      if (trail) trail.until((i + f) / Math.max(path.length - 1, 1));
      if (real) real.visible = state.real;
    },
  };
}

function solidOf(corners) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(corners, 3));
  geometry.computeBoundingBox();
  smoothNormals(geometry);
  return new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({roughness: 0.65, metalness: 0.0}));
}

// Of an ellipsoid, whose box is known.
function smoothNormals(geometry) {
  const centre = geometry.boundingBox.getCenter(new THREE.Vector3()), size = geometry.boundingBox.getSize(new THREE.Vector3());
  const p = geometry.attributes.position.array, normals = new Float32Array(p.length), n = new THREE.Vector3();
  for (let i = 0; i < p.length; i += 3) {
    n.set((p[i] - centre.x) / size.x ** 2, (p[i + 1] - centre.y) / size.y ** 2, (p[i + 2] - centre.z) / size.z ** 2).normalize();
    n.toArray(normals, i);
  }
  geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
}

// A flat wing with a colour a point on each side; the outline as a line.
function wingOf(run, link, points) {
  const [along, across] = points.shape, count = along * across, left = link === "left_wing";
  const positions = new Float32Array(3 * count), faces = [];
  for (let i = 0; i < count; ++i) positions.set([points[2 * i], points[2 * i + 1], 0], 3 * i);
  for (let i = 0; i + 1 < along; ++i) {
    for (let j = 0; j + 1 < across; ++j) {
      const a = i * across + j, b = a + 1, c = a + across, d = c + 1;
      faces.push(a, b, d, a, d, c);
    }
  }
  const group = new THREE.Group(), outline = [];
  const sides = ["dorsal", "ventral"].map(name => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setIndex(faces);
    // z points to the ventral side, which is the front of a right wing's faces.
    const front = (name === "ventral") !== left;
    const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({vertexColors: THREE.VertexColors, side: front ? THREE.FrontSide : THREE.BackSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
    group.add(mesh);
    return geometry.attributes.color;
  });
  const rim = (i, j) => outline.push(new THREE.Vector3(points[2 * (i * across + j)], points[2 * (i * across + j) + 1], 0));
  for (let i = 0; i < along; ++i) rim(i, 0);
  for (let j = 0; j < across; ++j) rim(along - 1, j);
  for (let i = along - 1; i >= 0; --i) rim(i, across - 1);
  const edge = new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(outline), new THREE.LineBasicMaterial());
  group.add(edge);
  const pictures = run.pressure && (run.pressure[link] || run.pressure.right_wing);  // mirrored: those of the right wing
  let plain = null;

  function coloured(t) {
    const {i, f} = rowAt(run.pressure.t, t), next = Math.min(i + 1, run.pressure.t.length - 1);
    sides.forEach((colours, side) => {
      const now = (2 * i + side) * count, then = (2 * next + side) * count;
      for (let k = 0; k < count; ++k) {
        const value = pictures[now + k] + f * (pictures[then + k] - pictures[now + k]);
        colours.array.set(pressureColours[Math.round(value) + 127], 3 * k);
      }
      colours.needsUpdate = true;
    });
    plain = false;
  }

  // Orange with a dark rim and light spots in it: a monarch.
  function pattern() {
    if (plain) return;
    sides.forEach(colours => {
      for (let k = 0; k < count; ++k) {
        const i = Math.floor(k / across), j = k % across, dark = j === 0 || j === across - 1 || i > along - 5;
        const spot = dark && i % 3 === 0 && i > along / 3 && j === 0;
        colours.array.set(spot ? [0.93, 0.88, 0.78] : dark ? [0.16, 0.13, 0.11] : [0.91, 0.49, 0.13], 3 * k);
      }
      colours.needsUpdate = true;
    });
    plain = true;
  }

  return {group, edge, show: (t, pressure) => pressure && pictures ? coloured(t) : pattern()};
}

// The path as a tube: all of it faint, what has been flown strong. None where nothing moves.
function trailOf(path, span) {
  const step = Math.max(1, Math.floor(path.length / 600)), kept = path.filter((_, i) => i % step === 0 || i === path.length - 1);
  const moved = kept.some(p => p.distanceTo(kept[0]) > 0.01 * span);
  if (!moved || kept.length < 2) return null;
  const segments = kept.length - 1, around = 6;
  const tube = radius => new THREE.TubeBufferGeometry(new THREE.CatmullRomCurve3(kept), segments, radius * span, around);
  const done = new THREE.Mesh(tube(0.016), new THREE.MeshBasicMaterial());
  const all = new THREE.Mesh(tube(0.008), new THREE.MeshBasicMaterial({transparent: true, opacity: 0.35}));
  return {done, all, until: share => done.geometry.setDrawRange(0, Math.round(share * segments) * 6 * around)};
}

function dotsOf(places, span) {
  const shape = new THREE.SphereBufferGeometry(0.016 * span, 8, 6), count = places.length / 3;
  const dots = new THREE.InstancedMesh(shape, new THREE.MeshBasicMaterial(), count), at = new THREE.Matrix4();
  for (let i = 0; i < count; ++i) dots.setMatrixAt(i, at.makeTranslation(places[3 * i], places[3 * i + 1], places[3 * i + 2]));
  dots.frustumCulled = false;
  return dots;
}
