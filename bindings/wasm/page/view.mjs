// SPDX-License-Identifier: MIT
// Draws triangles with WebGL: the model in space, to be turned with the mouse, or its page.
const VERTEX_SHADER = `#version 300 es
in vec3 place;
in vec2 uv;
in vec3 color;
in float chart;
uniform mat4 view;
out vec3 here;
out vec2 at;
out vec3 shade;
flat out float of_chart;
void main() {
  gl_Position = view * vec4(place, 1.0);
  here = place;
  at = uv;
  shade = color;
  of_chart = chart;
}`;
const FRAGMENT_SHADER = `#version 300 es
precision highp float;
in vec3 here;
in vec2 at;
in vec3 shade;
flat in float of_chart;
uniform float squares;   // of a checkerboard; 0: none
uniform vec3 light;      // where it comes from; 0: no shading
uniform float marked;    // the chart under the pointer; -1: none
uniform float is_line;
out vec4 result;
void main() {
  vec3 color = shade;
  if (squares > 0.0 && is_line < 0.5) {
    vec2 s = floor(at * squares);
    color = mix(color, vec3(1.0), mod(s.x + s.y, 2.0) < 0.5 ? 0.75 : 0.0);
  }
  if (light != vec3(0.0))
    color *= 0.4 + 0.6 * abs(dot(normalize(cross(dFdx(here), dFdy(here))), light));
  if (marked >= 0.0 && is_line < 0.5)
    color = abs(of_chart - marked) < 0.5 ? mix(color, vec3(1.0, 0.85, 0.2), 0.5) : color * 0.55;
  result = vec4(color, 1.0);
}`;

function compile(gl, type, source) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
  return shader;
}

function programOf(gl) {
  const program = gl.createProgram();
  gl.attachShader(program, compile(gl, gl.VERTEX_SHADER, VERTEX_SHADER));
  gl.attachShader(program, compile(gl, gl.FRAGMENT_SHADER, FRAGMENT_SHADER));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

/** The box of places, three numbers each: its middle, and half of its diagonal. */
export function boxOf(places) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < places.length; ++i)
    if (Number.isFinite(places[i])) {
      low[i % 3] = Math.min(low[i % 3], places[i]);
      high[i % 3] = Math.max(high[i % 3], places[i]);
    }
  const middle = low.map((x, i) => (x + high[i]) / 2);
  return { middle, radius: Math.hypot(...low.map((x, i) => high[i] - x)) / 2 || 1 };
}

/** A canvas with one mesh. */
export class View {
  constructor(canvas, { isFlat }) {
    this.canvas = canvas;
    this.isFlat = isFlat;
    this.gl = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
    if (!this.gl) throw new Error('this browser shows no WebGL 2');
    this.program = programOf(this.gl);
    this.squares = 0;
    this.marked = -1;
    this.turn = { around: 0.6, down: 0.35 };
    this.zoom = 1;
    this.shift = [0, 0];
    this.meshes = [];
    this.#listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** triangles and lines: { places, uvs, colors, charts }, arrays per corner */
  show(triangles, lines, box) {
    this.meshes.forEach(({ buffers, array }) => {
      buffers.forEach((buffer) => this.gl.deleteBuffer(buffer));
      this.gl.deleteVertexArray(array);
    });
    this.box = box;
    this.meshes = [this.#upload(triangles, this.gl.TRIANGLES), this.#upload(lines, this.gl.LINES)];
    this.draw();
  }

  reset() {
    this.turn = { around: 0.6, down: 0.35 };
    this.zoom = 1;
    this.shift = [0, 0];
    this.draw();
  }

  #upload(mesh, kind) {
    const { gl } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const buffers = [['place', mesh.places, 3], ['uv', mesh.uvs, 2], ['color', mesh.colors, 3], ['chart', mesh.charts, 1]]
      .map(([name, values, width]) => {
        const buffer = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
        const at = gl.getAttribLocation(this.program, name);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, width, gl.FLOAT, false, 0, 0);
        return buffer;
      });
    return { array, buffers, kind, count: mesh.places.length / 3 };
  }

  /** Right, up and towards the viewer, in the model's space. */
  #axes() {
    const { around, down } = this.turn;
    const [c, s, d, e] = [Math.cos(around), Math.sin(around), Math.cos(down), Math.sin(down)];
    return [[c, 0, s], [s * e, d, -c * e], [-s * d, e, c * d]];
  }

  /** From behind the viewer's left shoulder. */
  #light() {
    const [right, up, back] = this.#axes();
    return right.map((x, i) => -0.26 * x + 0.43 * up[i] + 0.86 * back[i]);
  }

  /** From places to the canvas, column by column. Lines are drawn a little nearer than they are. */
  #matrix(isLine) {
    const { width, height } = this.canvas;
    const scale = (this.isFlat ? 1.9 : 1 / this.box.radius) * this.zoom;
    const fit = [scale * Math.min(1, height / width), scale * Math.min(1, width / height)];
    const [x, y] = this.shift;
    const nearer = isLine ? -0.002 : 0;
    if (this.isFlat) return [fit[0], 0, 0, 0, 0, fit[1], 0, 0, 0, 0, 0, 0, x - fit[0] / 2, y - fit[1] / 2, nearer, 1];
    const scales = [fit[0], fit[1], -0.45 / this.box.radius];
    const rows = this.#axes().map((axis, i) => axis.map((a) => a * scales[i]));
    const move = rows.map((row) => -row.reduce((sum, a, i) => sum + a * this.box.middle[i], 0));
    return [0, 1, 2].flatMap((i) => [rows[0][i], rows[1][i], rows[2][i], 0]).concat([move[0] + x, move[1] + y, move[2] + nearer, 1]);
  }

  draw() {
    const { gl, canvas, program } = this;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.965, 0.97, 0.98, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (!this.meshes.length) return;
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(program);
    const set = (name, value) => gl.uniform1f(gl.getUniformLocation(program, name), value);
    set('squares', this.squares);
    set('marked', this.marked);
    this.meshes.forEach(({ array, kind, count }) => {
      const isLine = kind === gl.LINES;
      gl.uniform3fv(gl.getUniformLocation(program, 'light'), this.isFlat || isLine ? [0, 0, 0] : this.#light());
      set('is_line', isLine ? 1 : 0);
      gl.uniformMatrix4fv(gl.getUniformLocation(program, 'view'), false, this.#matrix(isLine));
      gl.bindVertexArray(array);
      gl.drawArrays(kind, 0, count);
    });
  }

  /** The place on the page below a pointer. */
  pageAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const x = (2 * (event.clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (event.clientY - box.top)) / box.height;
    const scale = 1.9 * this.zoom;
    const fit = [scale * Math.min(1, box.height / box.width), scale * Math.min(1, box.width / box.height)];
    return [(x - this.shift[0]) / fit[0] + 0.5, (y - this.shift[1]) / fit[1] + 0.5];
  }

  #listen() {
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener('pointermove', (event) => {
      if (!event.buttons) return;
      if (this.isFlat || event.buttons !== 1 || event.shiftKey) {
        this.shift[0] += (2 * event.movementX) / canvas.clientWidth;
        this.shift[1] -= (2 * event.movementY) / canvas.clientHeight;
      } else {
        this.turn.around += event.movementX * 0.008;
        this.turn.down = Math.max(-1.57, Math.min(1.57, this.turn.down + event.movementY * 0.008));
      }
      this.draw();
    });
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom = Math.max(0.2, Math.min(80, this.zoom * Math.exp(-event.deltaY * 0.001)));
      this.draw();
    }, { passive: false });
    canvas.addEventListener('dblclick', () => this.reset());
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  }
}
