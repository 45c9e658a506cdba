// Drawing of the layers of a film with WebGL2.

const VERTEX = `#version 300 es
  in vec3 place;
  in vec3 normal;
  in float value;
  uniform vec3 low, span;
  uniform mat4 body, view;
  uniform float dot_px;
  out vec3 at;
  out vec3 outwards;
  out float share;
  void main() {
    vec4 position = body * vec4(low + span * place, 1.0);
    at = position.xyz;
    outwards = normal;
    share = value;
    gl_Position = view * position;
    gl_PointSize = max(1.5, dot_px / gl_Position.w);
  }`;

// `mode` 0: triangles with the normals of their planes, 1: triangles with the normals of the points, 2: dots, 3: number
// of the body as a colour, for the choice of a body in the picture.
const FRAGMENT = `#version 300 es
  precision highp float;
  precision highp int;
  in vec3 at;
  in vec3 outwards;
  in float share;
  uniform int mode, colour_count, body_number;
  uniform vec3 plain, eye, right, up, colours[10];
  uniform float opacity;
  out vec4 pixel;
  void main() {
    if (mode == 3) {
      pixel = vec4(float(body_number & 255), float(body_number >> 8 & 255), float(body_number >> 16 & 255), 255.0) / 255.0;
      return;
    }
    vec3 base = plain;
    if (colour_count > 0) {
      base = colours[clamp(int(share * float(colour_count)), 0, colour_count - 1)];
    }
    vec3 towards = normalize(eye - at);
    vec3 facing;
    if (mode == 2) {
      vec2 offset = 2.0 * gl_PointCoord - 1.0;
      float rest = 1.0 - dot(offset, offset);
      if (rest < 0.0) discard;
      facing = offset.x * right - offset.y * up + sqrt(rest) * towards;
    } else {
      facing = mode == 1 ? normalize(outwards) : normalize(cross(dFdx(at), dFdy(at)));
      if (dot(facing, towards) < 0.0) facing = -facing;
    }
    vec3 light = normalize(towards + 0.7 * up - 0.5 * right);
    float bright = 0.52 + 0.48 * max(dot(facing, light), 0.0);
    pixel = vec4(base * bright, opacity);
  }`;

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function rgb(colour) {
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255);
}

class Drawing {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL2");
    this.canvas = canvas;
    this.gl = gl;
    this.program = this.linked(VERTEX, FRAGMENT);
    this.uniforms = {};
    const count = gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS);
    for (let i = 0; i < count; i += 1) {
      const name = gl.getActiveUniform(this.program, i).name.replace("[0]", "");
      this.uniforms[name] = gl.getUniformLocation(this.program, name);
    }
    gl.useProgram(this.program);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.cullFace(gl.FRONT);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.clearColor(1, 1, 1, 1);
  }

  linked(vertex, fragment) {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    ["place", "normal", "value"].forEach((name, index) => gl.bindAttribLocation(program, index, name));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  // Returns an empty mesh on the card. `fill` sets its content.
  mesh() {
    const { gl } = this;
    const array = gl.createVertexArray();
    return { array, places: gl.createBuffer(), normals: gl.createBuffer(), values: gl.createBuffer(),
      corners: gl.createBuffer(), count: 0, dots: false, smooth: false };
  }

  // Sets the numbers of an attribute, `size` per point. Integers are shares of their largest value.
  attribute(index, buffer, data, size, type) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(index);
    gl.vertexAttribPointer(index, size, type, type !== gl.FLOAT, 0, 0);
  }

  // Sets the points (integers 0 to 65535 for the box of the layer), and the triangles or null for dots. `normals` and
  // `values` (0 to 1 for the colour scale) may be null.
  fill(mesh, points, triangles, normals) {
    const { gl } = this;
    gl.bindVertexArray(mesh.array);
    this.attribute(0, mesh.places, Uint16Array.from(points), 3, gl.UNSIGNED_SHORT);
    mesh.smooth = Boolean(normals);
    if (normals) {
      this.attribute(1, mesh.normals, normals, 3, gl.FLOAT);
    } else {
      gl.disableVertexAttribArray(1);
      gl.vertexAttrib3f(1, 0, 0, 1);
    }
    mesh.dots = !triangles;
    mesh.count = triangles ? triangles.length : points.length / 3;
    if (triangles) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.corners);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.DYNAMIC_DRAW);
    }
    gl.bindVertexArray(null);
  }

  // Sets the value of each point on the colour scale (bytes 0 to 255), or one value for all points.
  paint(mesh, values) {
    const { gl } = this;
    gl.bindVertexArray(mesh.array);
    this.attribute(2, mesh.values, Uint8Array.from(values), 1, gl.UNSIGNED_BYTE);
    gl.bindVertexArray(null);
  }

  // Fits the picture to the size of the canvas on the page. Returns true if its size changes, which clears it.
  fit() {
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight].map((px) => Math.max(1, Math.round(px * scale)));
    if (this.canvas.width === width && this.canvas.height === height) return false;
    Object.assign(this.canvas, { width, height });
    return true;
  }

  // Draws a list of objects { mesh, low, span, body, colours, share, plain, opacity, dot, number }: first the opaque
  // ones, then the nearest face of each transparent one.
  draw(camera, objects) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.look(camera);
    gl.disable(gl.BLEND);
    const clear = objects.filter((object) => object.opacity < 1);
    objects.filter((object) => object.opacity >= 1).forEach((object) => this.drawOne(object));
    gl.colorMask(false, false, false, false);
    clear.forEach((object) => this.drawOne(object));
    gl.colorMask(true, true, true, true);
    gl.enable(gl.BLEND);
    clear.forEach((object) => this.drawOne(object));
  }

  // Returns the number of the body at a position in the picture, counted from the upper left corner in shares of its
  // width and height; 0 without a body.
  bodyAt(camera, objects, x, y) {
    const { gl, canvas } = this;
    const frame = gl.createFramebuffer();
    const buffers = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]].forEach(([format, place], i) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffers[i]);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, canvas.width, canvas.height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffers[i]);
    });
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.disable(gl.BLEND);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.clearColor(1, 1, 1, 1);
    this.look(camera);
    objects.filter((object) => object.opacity >= 1).forEach((object) => this.drawOne(object, true));
    const pixel = new Uint8Array(4);
    gl.readPixels(Math.floor(x * canvas.width), Math.floor((1 - y) * canvas.height), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.deleteFramebuffer(frame);
    buffers.forEach((buffer) => gl.deleteRenderbuffer(buffer));
    return pixel[0] + 256 * pixel[1] + 65536 * pixel[2];
  }

  look(camera) {
    const { gl, uniforms } = this;
    const { right, up } = camera.axes();
    gl.uniformMatrix4fv(uniforms.view, false, camera.matrix());
    gl.uniform3fv(uniforms.eye, camera.eye());
    gl.uniform3fv(uniforms.right, right);
    gl.uniform3fv(uniforms.up, up);
  }

  drawOne(object, asNumber = false) {
    const { gl, uniforms } = this;
    const { mesh } = object;
    if (mesh.count === 0) return;
    const mode = asNumber ? 3 : mesh.dots ? 2 : mesh.smooth ? 1 : 0;
    gl.uniform1i(uniforms.mode, mode);
    gl.uniform1i(uniforms.body_number, object.number || 0);
    gl.uniform3fv(uniforms.low, object.low);
    gl.uniform3fv(uniforms.span, object.span);
    gl.uniformMatrix4fv(uniforms.body, false, object.body || IDENTITY);
    if (object.seen === "inside") gl.enable(gl.CULL_FACE);
    else gl.disable(gl.CULL_FACE);
    gl.uniform1f(uniforms.dot_px, (object.dot || 0) * this.canvas.height / (2 * Math.tan(FIELD_OF_VIEW / 2)));
    gl.uniform3fv(uniforms.plain, rgb(object.plain));
    gl.uniform1f(uniforms.opacity, object.opacity);
    const colours = object.colours || [];
    gl.uniform1i(uniforms.colour_count, colours.length);
    if (colours.length > 0) gl.uniform3fv(uniforms.colours, colours.flatMap(rgb));
    gl.bindVertexArray(mesh.array);
    if (object.share !== undefined) {
      gl.disableVertexAttribArray(2);
      gl.vertexAttrib1f(2, object.share);
    }
    if (mesh.dots) gl.drawArrays(gl.POINTS, 0, mesh.count);
    else gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  }
}
