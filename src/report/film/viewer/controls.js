// Controls of the film: buttons, lists, mouse, touch and keyboard.

const STEP = 0.08;
const STORE = "breakwater film";

function connect(film) {
  const get = (id) => document.getElementById(`film-${id}`);
  const canvas = get("picture");
  const { clock } = film.head;
  const changed = () => {
    film.hasMoved = true;
    film.isStale = true;
    remember(film);
  };

  const slider = get("time");
  slider.max = film.times.length - 1;
  slider.addEventListener("input", () => film.goTo(Number(slider.value)));
  film.onDraw = (time) => {
    const words = `${time.toFixed(clock.digits).replace("-", "\u2212")} ${clock.unit}`;
    slider.value = film.at;
    slider.setAttribute("aria-valuetext", words);
    get("clock").textContent = words;
    remember(film);
  };

  const play = get("play");
  play.addEventListener("click", () => film.play(!film.isPlaying));
  film.onPlay = (isPlaying) => {
    play.textContent = isPlaying ? "Pause" : "Play";
  };

  const seconds = (film.times[film.times.length - 1] - film.times[0]) / clock.per_second;
  const speed = get("speed");
  for (const length of [5, 10, 20, 40, 80]) {
    speed.append(element("option", { value: length }, `${length} s (${digits(seconds / length)} \u00d7 real time)`));
  }
  speed.value = String(film.length);
  speed.addEventListener("change", () => {
    film.length = Number(speed.value);
    remember(film);
  });
  const view = get("view");
  view.value = film.view;
  view.addEventListener("change", () => {
    film.view = view.value;
    showView(film);
  });

  const layers = get("layers");
  for (const parts of layersOf(film)) addLayer(film, layers, parts);
  showLegend(film);
  connectPointer(film, canvas, changed);
  canvas.addEventListener("keydown", (event) => {
    if (press(film, event, changed)) event.preventDefault();
  });
  get("save").addEventListener("click", () => savePicture(canvas, film));
  connectRecorder(film, canvas, get("record"));
  // A phone may take the graphics memory away from a page in the background.
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => location.reload());
}

// Shows the chosen view from its first place.
function showView(film) {
  film.camera.show(film.view);
  film.hasMoved = false;
  film.isStale = true;
  remember(film);
}

// Returns the layers of a film. Series with the same name are parts of one layer.
function layersOf(film) {
  const layers = new Map();
  for (const part of [...film.series, film.bodies].filter(Boolean)) {
    layers.set(part.name, [...(layers.get(part.name) || []), part]);
  }
  return [...layers.values()];
}

// Adds the switch of a layer, and the list of its colours.
function addLayer(film, parent, parts) {
  const [layer] = parts;
  const row = element("span", { class: "film-layer" });
  const label = element("label");
  const box = element("input", { type: "checkbox" });
  box.checked = layer.visible;
  box.addEventListener("change", () => {
    parts.forEach((part) => {
      part.visible = box.checked;
    });
    showLegend(film);
    film.isStale = true;
  });
  label.append(box, ` ${layer.name}`);
  row.append(label);
  if (layer.fields.length > 1) {
    const choice = element("select", { "aria-label": `colour of: ${layer.name}` });
    layer.fields.forEach((field, index) => choice.append(element("option", { value: index }, field.name)));
    choice.value = String(layer.field);
    choice.addEventListener("change", () => {
      parts.forEach((part) => {
        part.field = Number(choice.value);
      });
      showLegend(film);
      film.isStale = true;
    });
    row.append(choice);
  }
  parent.append(row);
}

function bar(...parts) {
  const whole = element("span", { class: "film-bar" });
  whole.append(...parts);
  return whole;
}

function showLegend(film) {
  const legend = document.getElementById("film-legend");
  legend.replaceChildren();
  for (const [layer] of layersOf(film).filter(([one]) => one.visible && one.fields.length > 0)) {
    const field = layer.fields[layer.field];
    const row = element("div", { class: "film-scale" });
    const name = `${layer.name}: ${field.name}${field.unit ? ` [${field.unit}]` : ""}`;
    row.append(element("span", {}, name));
    const parts = field.colours.map((colour) => element("i", { style: `background:${colour}` }));
    if (field.labels) {
      // Each colour stays with its label if the row is too long for the screen.
      parts.forEach((part, index) => row.append(bar(part, element("span", {}, field.labels[index]))));
    } else {
      const [low, high] = field.range.map((value) => element("span", {}, digits(value)));
      row.append(bar(low, ...parts, high));
    }
    legend.append(row);
  }
}

// Turns, moves and zooms with one or two pointers (mouse or fingers). A click, or a tap of a finger, chooses a unit.
function connectPointer(film, canvas, changed) {
  const pointers = new Map();
  // Farthest distance of the pointer from its first place, and the distance from which it is a drag [px].
  let start = null;
  let isDrag = false;
  const slop = (event) => (event.pointerType === "touch" ? 12 : 4);
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
    start = event;
    isDrag = pointers.size > 1;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    isDrag ||= Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY) > slop(event);
    if (!isDrag) return;
    const height = canvas.clientHeight;
    const [dx, dy] = [event.clientX - before.clientX, event.clientY - before.clientY];
    if (pointers.size === 2) {
      const other = [...pointers.values()].find((pointer) => pointer.pointerId !== event.pointerId);
      const apart = (pointer) => Math.hypot(pointer.clientX - other.clientX, pointer.clientY - other.clientY);
      film.camera.zoom(apart(event) / (apart(before) || 1));
      film.camera.pan(dx / height / 2, dy / height / 2);
    } else if (event.shiftKey || event.buttons === 2 || event.buttons === 4) {
      film.camera.pan(dx / height, dy / height);
    } else {
      film.camera.orbit(-4 * dx / height, 4 * dy / height);
    }
    pointers.set(event.pointerId, event);
    changed();
  });
  const release = (event) => {
    const isLast = pointers.delete(event.pointerId) && pointers.size === 0;
    if (isLast && !isDrag && event.type === "pointerup" && film.bodies) {
      const box = canvas.getBoundingClientRect();
      film.pick((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
    }
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    film.camera.zoom(Math.exp(-0.0015 * event.deltaY));
    changed();
  }, { passive: false });
}

// Acts on a key. Returns false if the key has no meaning here. `changed` is called if the key moves the camera.
function press(film, { key, shiftKey, ctrlKey, altKey, metaKey }, changed) {
  if (ctrlKey || altKey || metaKey) return false;
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  if (arrows[key]) {
    const [x, y] = arrows[key].map((sign) => sign * STEP);
    if (shiftKey) film.camera.pan(-x, y);
    else film.camera.orbit(x, y);
    changed();
    return true;
  }
  const zoom = (factor) => {
    film.camera.zoom(factor);
    changed();
  };
  const actions = {
    "+": () => zoom(1.15),
    "=": () => zoom(1.15),
    "-": () => zoom(1 / 1.15),
    " ": () => film.play(!film.isPlaying),
    ",": () => film.goTo(Math.ceil(film.at) - 1),
    ".": () => film.goTo(Math.floor(film.at) + 1),
    Home: () => showView(film),
  };
  actions[key]?.();
  return Boolean(actions[key]);
}

function save(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function savePicture(canvas, film) {
  film.isStale = true;
  film.draw();
  canvas.toBlob((blob) => save(blob, `film ${film.time().toFixed(film.head.clock.digits)}.png`), "image/png");
}

// Records the film from its start to its end in the present view, as MP4 if the browser has an encoder for it, otherwise
// as WebM.
function connectRecorder(film, canvas, button) {
  const kinds = ["video/mp4", "video/webm"].filter((kind) => window.MediaRecorder?.isTypeSupported(kind));
  if (kinds.length === 0 || !canvas.captureStream) return;
  button.hidden = false;
  button.addEventListener("click", () => {
    const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: kinds[0], videoBitsPerSecond: 12e6 });
    const parts = [];
    const { onPlay } = film;
    recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
    recorder.addEventListener("stop", () => {
      button.disabled = false;
      film.isRecording = false;
      film.onPlay = onPlay;
      save(new Blob(parts, { type: kinds[0] }), `film.${kinds[0].slice(6)}`);
    });
    button.disabled = true;
    film.isRecording = true;
    film.goTo(0);
    film.play(true);
    film.onPlay = (isPlaying) => {
      onPlay(isPlaying);
      if (!isPlaying) setTimeout(() => recorder.stop(), 200);
    };
    recorder.start();
  });
}

// Keeps what the viewer has chosen for the next load of the page: the page of a running simulation loads itself again.
function remember(film) {
  const { turn, tilt, distance, target } = film.camera;
  const layers = layersOf(film).map(([{ name, visible, field }]) => ({ name, visible, field }));
  const { view, hasMoved, length, chosen } = film;
  const isAtEnd = film.at >= film.times.length - 1;
  const kept = { camera: { turn, tilt, distance, target }, view, hasMoved, length, chosen, layers, isAtEnd, time: film.time() };
  try {
    sessionStorage.setItem(STORE + location.pathname, JSON.stringify(kept));
  } catch {
    // A page without storage starts at its first view.
  }
}

function recall(film) {
  try {
    const kept = JSON.parse(sessionStorage.getItem(STORE + location.pathname));
    if (!kept) return;
    const { view, hasMoved, length, layers } = kept;
    Object.assign(film, { view, hasMoved, length });
    if (hasMoved) Object.assign(film.camera, kept.camera);
    for (const { name, visible, field } of layers) {
      [...film.series, film.bodies].filter((part) => part?.name === name && part.fields.length >= field).forEach((part) => {
        Object.assign(part, { visible, field: Math.min(field, Math.max(0, part.fields.length - 1)) });
      });
    }
    // The viewer who looks at the newest water sees the newer water.
    if (kept.isAtEnd) film.goTo(film.times.length - 1);
    else film.goToTime(kept.time);
    if (kept.chosen) film.choose(kept.chosen);
  } catch {
    // As above.
  }
}
