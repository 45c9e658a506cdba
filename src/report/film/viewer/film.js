// The film: its state, its controls, and the loop that draws it.

// Returns the edges of the box of a mesh.
const span = ({ low, high }) => low.map((value, axis) => high[axis] - value);

class Film {
  constructor(head, bytes) {
    this.head = head;
    this.bytes = bytes;
    this.times = head.times;
    this.at = head.start;
    this.length = 10;
    this.isPlaying = false;
    this.isRecording = false;
    this.chosen = 0;
    this.view = "corner";
    this.drawing = new Drawing(document.getElementById("film-picture"));
    const corners = head.series.filter((series) => series.frames.length > 0).flatMap(({ low, high }) => [low, high]);
    this.camera = new Camera(head.box[0], head.box[1], corners);
    this.series = head.series.map((series) => ({ ...series, mesh: this.drawing.mesh(), frame: -1, field: 0, visible: true }));
    this.bodies = head.bodies && this.unpackedBodies(head.bodies);
    this.panel = this.bodies && new Panel(bytes, this.times, head.bodies, (number) => this.choose(number));
    this.isStale = true;
  }

  unpackedBodies(bodies) {
    const meshes = bodies.meshes.map((shape) => {
      const mesh = this.drawing.mesh();
      this.drawing.fill(mesh, integers(this.bytes, shape.points), integers(this.bytes, shape.triangles), null);
      return { mesh, low: shape.low, span: span(shape) };
    });
    const values = bodies.fields.map((field) => numbers(this.bytes, field.values));
    const [position, turn] = [bodies.position, bodies.orientation].map((array) => numbers(this.bytes, array));
    return { ...bodies, meshes, values, position, turn, field: 0, visible: true };
  }

  // True while a new load of the page would disturb the viewer.
  isBusy() {
    return this.isPlaying || this.isRecording;
  }

  // Moves to a time.
  goToTime(time) {
    const after = this.times.findIndex((one) => one > time);
    if (after < 0) this.goTo(this.times.length - 1);
    else if (after === 0) this.goTo(0);
    else this.goTo(after - 1 + (time - this.times[after - 1]) / (this.times[after] - this.times[after - 1]));
  }

  // Moves to a frame; a number between two frames is between their times.
  goTo(frame) {
    this.at = Math.min(this.times.length - 1, Math.max(0, frame));
    this.isStale = true;
  }

  time() {
    const before = Math.floor(this.at);
    const after = Math.min(before + 1, this.times.length - 1);
    return this.times[before] + (this.at - before) * (this.times[after] - this.times[before]);
  }

  choose(number) {
    this.chosen = number;
    this.panel?.show(number);
    this.isStale = true;
  }

  play(isPlaying) {
    this.isPlaying = isPlaying;
    if (isPlaying && this.at >= this.times.length - 1) this.goTo(0);
    this.onPlay?.(isPlaying);
  }

  // Advances the film by a time of the viewer [s].
  advance(seconds) {
    if (!this.isPlaying) return;
    this.goTo(this.at + seconds / this.length * (this.times.length - 1));
    if (this.at >= this.times.length - 1) this.play(false);
  }

  // Loads the frame of a series that belongs to the current time, if it is not loaded yet.
  load(series) {
    const frame = Math.min(Math.round(this.at), series.frames.length - 1);
    const key = `${frame} ${series.field}`;
    if (series.loaded === key) return;
    series.loaded = key;
    const { points, triangles, values } = series.frames[frame];
    if (series.frame !== frame) {
      series.frame = frame;
      const places = integers(this.bytes, points);
      const corners = triangles && integers(this.bytes, triangles);
      let normals = null;
      if (series.smooth) {
        const { low, high } = series;
        normals = smoothNormals(places.length ? Float32Array.from(places, (value, i) => (high[i % 3] - low[i % 3]) * value) : [], corners);
      }
      this.drawing.fill(series.mesh, places, corners, normals);
    }
    if (series.fields.length > 0) this.drawing.paint(series.mesh, integers(this.bytes, values[series.field]));
  }

  // Returns the list of objects that the drawing shows.
  objects() {
    const objects = [];
    for (const series of this.series.filter((one) => one.visible)) {
      this.load(series);
      const colours = series.fields[series.field]?.colours;
      objects.push({ ...series, span: span(series), colours });
    }
    if (this.bodies?.visible) objects.push(...this.bodyObjects());
    return objects;
  }

  bodyObjects() {
    const { bodies } = this;
    const count = bodies.list.length;
    const before = Math.floor(this.at);
    const after = Math.min(before + 1, this.times.length - 1);
    const share = this.at - before;
    const field = bodies.fields[bodies.field];
    return bodies.list.map(({ number, mesh }, index) => {
      const between = (list, parts) => Array.from({ length: parts }, (_, k) => {
        const [a, b] = [before, after].map((frame) => list[(frame * count + index) * parts + k]);
        return a + share * (b - a);
      });
      const [x, y, z, w] = between(bodies.turn, 4);
      const length = Math.hypot(x, y, z, w) || 1;
      const body = placed(between(bodies.position, 3), [x, y, z, w].map((part) => part / length));
      const [value] = between(bodies.values[bodies.field], 1);
      const [low, high] = field.range;
      return {
        ...bodies.meshes[mesh], body, number, opacity: 1,
        plain: number === this.chosen ? "#e69f00" : "#8a929a",
        colours: number === this.chosen ? [] : field.colours,
        share: Math.min(0.999, Math.max(0, (value - low) / (high - low || 1))),
      };
    });
  }

  draw() {
    if (this.drawing.fit()) {
      this.camera.aspect = this.drawing.canvas.width / this.drawing.canvas.height;
      if (!this.hasMoved) this.camera.show(this.view);
      this.isStale = true;
    }
    if (!this.isStale) return;
    this.isStale = false;
    this.drawing.draw(this.camera, this.objects());
    this.onDraw?.(this.time());
    this.panel?.moveTo(this.time());
  }

  // Chooses the body at a position in the picture, in shares of its width and height from the upper left corner.
  pick(x, y) {
    this.choose(this.drawing.bodyAt(this.camera, this.objects(), x, y));
  }
}
