// Arrays of a film. The page contains them as one text: base64 of a zlib stream. An array lists its position in the
// unpacked bytes (`at`), the number of its entries (`count`), the number of components of an entry (`parts`) and the
// number of bytes of a component (`size`). For each component, the bytes contain the differences between successive
// entries, all lowest bytes first.

async function unpack(text) {
  const letters = atob(text.trim());
  const packed = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i += 1) packed[i] = letters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Returns the integers of an array, entry by entry. The differences are stored as 0, -1, 1, -2, 2 ... = 0, 1, 2, 3, 4.
function integers(bytes, { at, count, parts, size }) {
  const values = new Uint32Array(count * parts);
  for (let part = 0; part < parts; part += 1) {
    let value = 0;
    for (let i = 0; i < count; i += 1) {
      let coded = 0;
      for (let byte = size - 1; byte >= 0; byte -= 1) {
        coded = coded * 256 + bytes[at + (part * size + byte) * count + i];
      }
      value += coded % 2 === 1 ? -(coded + 1) / 2 : coded / 2;
      values[i * parts + part] = value;
    }
  }
  return values;
}

// Returns the numbers of an array whose integers from 0 to 65535 stand for the range `low` to `high` of each component.
function numbers(bytes, array) {
  const { parts, low, high } = array;
  return Float32Array.from(integers(bytes, array), (value, i) => {
    const part = i % parts;
    return low[part] + (high[part] - low[part]) * value / 65535;
  });
}

// Returns the unit normal of each point: the mean of the triangles around it, weighted with their areas.
function smoothNormals(points, triangles) {
  const normals = new Float32Array(points.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]];
    const [vx, vy, vz] = [points[c] - points[a], points[c + 1] - points[a + 1], points[c + 2] - points[a + 2]];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) {
      normals[corner] += nx;
      normals[corner + 1] += ny;
      normals[corner + 2] += nz;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let axis = 0; axis < 3; axis += 1) normals[i + axis] /= length;
  }
  return normals;
}
