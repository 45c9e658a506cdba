// Camera that turns around a point of the scene. Matrices are lists of 16 numbers, column by column, as in WebGL.

const VIEWS = {
  corner: { turn: -0.5, tilt: 0.42 },
  side: { turn: 0, tilt: 0 },
  plan: { turn: 0, tilt: Math.PI / 2 },
  sea: { turn: -Math.PI / 2, tilt: 0.15 },
  shore: { turn: Math.PI / 2, tilt: 0.15 },
};
const FIELD_OF_VIEW = 0.55;

function product(a, b) {
  const c = new Array(16).fill(0);
  for (let column = 0; column < 4; column += 1) {
    for (let row = 0; row < 4; row += 1) {
      for (let k = 0; k < 4; k += 1) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return c;
}

// Matrix of a body at a position with an orientation (quaternion x, y, z, w).
function placed([px, py, pz], [x, y, z, w]) {
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0,
    2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0,
    px, py, pz, 1,
  ];
}

class Camera {
  // `low` and `high` are the corners of the box that the camera shows at the start [m]; `corners` are the corners of
  // everything that may be in the picture.
  constructor(low, high, corners) {
    this.box = [low, high];
    this.corners = [low, high, ...corners];
    this.aspect = 1;
    this.show("corner");
  }

  // Turns the camera to a named view that shows the whole box.
  show(view) {
    const [low, high] = this.box;
    this.target = low.map((value, axis) => (value + high[axis]) / 2);
    Object.assign(this, VIEWS[view]);
    const half = low.map((value, axis) => (high[axis] - value) / 2);
    const { right, up, back } = this.axes();
    const extent = (axis) => half.reduce((sum, value, k) => sum + Math.abs(value * axis[k]), 0);
    const height = Math.max(extent(up), extent(right) / this.aspect);
    this.radius = Math.hypot(...half);
    this.distance = 1.04 * height / Math.tan(FIELD_OF_VIEW / 2) + extent(back);
  }

  // Unit vectors to the right and up in the picture, and from the scene towards the viewer.
  axes() {
    const [st, ct, sk, ck] = [Math.sin(this.turn), Math.cos(this.turn), Math.sin(this.tilt), Math.cos(this.tilt)];
    return { right: [ct, st, 0], up: [-st * sk, ct * sk, ck], back: [st * ck, -ct * ck, sk] };
  }

  orbit(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.min(Math.PI / 2, Math.max(-0.3, this.tilt + tilt));
  }

  // Moves the scene in the picture by shares of the height of the picture.
  pan(x, y) {
    const { right, up } = this.axes();
    const height = 2 * this.distance * Math.tan(FIELD_OF_VIEW / 2);
    this.target = this.target.map((value, axis) => value - height * (x * right[axis] - y * up[axis]));
  }

  zoom(factor) {
    this.distance = Math.min(40 * this.radius, Math.max(0.05 * this.radius, this.distance / factor));
  }

  eye() {
    const { back } = this.axes();
    return this.target.map((value, axis) => value + this.distance * back[axis]);
  }

  // Matrix from positions [m] to the picture.
  matrix() {
    const { right, up, back } = this.axes();
    const eye = this.eye();
    const dot = (axis) => axis[0] * eye[0] + axis[1] * eye[1] + axis[2] * eye[2];
    const turned = [
      right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
      -dot(right), -dot(up), -dot(back), 1,
    ];
    const reach = Math.max(...this.corners.map((corner) => Math.hypot(...corner.map((value, k) => value - this.target[k]))));
    const far = this.distance + reach;
    const near = Math.max(this.distance - reach, 0.002 * far);
    const scale = 1 / Math.tan(FIELD_OF_VIEW / 2);
    const perspective = [
      scale / this.aspect, 0, 0, 0, 0, scale, 0, 0,
      0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0,
    ];
    return product(perspective, turned);
  }
}
