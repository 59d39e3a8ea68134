// A parallel projection of points in world axes, z up, as a picture: x to the right, y down, depth towards the reader.
export const homeTurn = { azimuth: -58, elevation: 22, zoom: 1 }; // degrees: where the reader stands

const radians = (degrees) => (degrees * Math.PI) / 180;

// turn: as homeTurn; frame: {center, scale (pixels per length), x, y (the picture's middle)}
export function camera({ azimuth, elevation, zoom }, { center, scale, x, y }) {
  const [ca, sa, ce, se] = [Math.cos(radians(azimuth)), Math.sin(radians(azimuth)), Math.cos(radians(elevation)), Math.sin(radians(elevation))];
  const right = [-sa, ca, 0], up = [-se * ca, -se * sa, ce], near = [ce * ca, ce * sa, se];
  const along = (axis, p) => axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
  const direction = (p) => [along(right, p), -along(up, p)];
  const size = scale * zoom;
  return {
    size,
    direction, // of a vector, without the scale
    project(p) {
      const q = [p[0] - center[0], p[1] - center[1], p[2] - center[2]];
      const [dx, dy] = direction(q);
      return { x: x + size * dx, y: y + size * dy, depth: along(near, q) };
    },
  };
}

// The frame in which all points fit a picture however they are turned about z, at the home elevation.
export function fitted(points, width, height, margin) {
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  for (const p of points) {
    for (let k = 0; k < 3; ++k) { least[k] = Math.min(least[k], p[k]); most[k] = Math.max(most[k], p[k]); }
  }
  const center = least.map((value, k) => (value + most[k]) / 2);
  const around = Math.max(...points.map((p) => Math.hypot(p[0] - center[0], p[1] - center[1])));
  const above = (most[2] - least[2]) / 2;
  const e = radians(homeTurn.elevation);
  const scale = Math.min((width / 2 - margin) / (around || 1e-9), (height / 2 - margin) / (above * Math.cos(e) + around * Math.sin(e) || 1e-9));
  return { center, scale, around, least, most, size: 2 * Math.hypot(around, above), x: width / 2, y: height / 2 };
}
