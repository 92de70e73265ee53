// SPDX-License-Identifier: MIT
// A model for visitors who have none at hand: a tube around a knot, with a wavy skin.

function pointOf(u, v) {
  const at = (t) => [Math.cos(2 * t) * (2.2 + 0.8 * Math.cos(3 * t)), Math.sin(2 * t) * (2.2 + 0.8 * Math.cos(3 * t)), 0.9 * Math.sin(3 * t)];
  const [p, q] = [at(u), at(u + 0.001)];
  const along = unit(q.map((x, i) => x - p[i]));
  const side = unit(cross(along, [0, 0, 1]));
  const up = cross(side, along);
  const radius = 0.5 + 0.05 * Math.cos(6 * v + 12 * u);
  return p.map((x, i) => x + radius * (Math.cos(v) * side[i] + Math.sin(v) * up[i]));
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function unit(a) {
  const length = Math.hypot(...a);
  return a.map((x) => x / length);
}

/** As a file, the way a visitor would give one. */
export function exampleModel(long = 180, around = 28) {
  const lines = [`OFF ${long * around} ${long * around} 0`];
  for (let i = 0; i < long; ++i)
    for (let k = 0; k < around; ++k)
      lines.push(pointOf((2 * Math.PI * i) / long, (2 * Math.PI * k) / around).map((x) => x.toFixed(6)).join(' '));
  const vertex = (i, k) => (i % long) * around + (k % around);
  for (let i = 0; i < long; ++i)
    for (let k = 0; k < around; ++k)
      lines.push(`4 ${vertex(i, k)} ${vertex(i + 1, k)} ${vertex(i + 1, k + 1)} ${vertex(i, k + 1)}`);
  return new File([lines.join('\n')], 'knot.off');
}
