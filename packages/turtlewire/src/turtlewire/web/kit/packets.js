// Packets of the server: a header in JSON, and arrays that are used where they lie.

const ALIGNMENT = 8;
const KINDS = {
  f4: Float32Array,
  f8: Float64Array,
  i1: Int8Array,
  u1: Uint8Array,
  i2: Int16Array,
  u2: Uint16Array,
  i4: Int32Array,
  u4: Uint32Array,
};
const text = new TextDecoder();

/**
 * Take a packet apart: the header's fields, and `arrays` as name to typed array. The arrays are
 * views of `buffer`; `shapes` holds what the header said of them.
 */
export function decodePacket(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(text.decode(new Uint8Array(buffer, 4, length)));
  const arrays = {};
  const shapes = {};
  let at = 4 + length;
  for (const [name, [kind, shape]] of Object.entries(header.arrays ?? {})) {
    const Kind = KINDS[kind];
    if (!Kind) throw new Error(`array "${name}" has the unknown kind "${kind}"`);
    arrays[name] = new Kind(buffer, at, shape.reduce((a, b) => a * b, 1));
    shapes[name] = shape;
    at += Math.ceil(arrays[name].byteLength / ALIGNMENT) * ALIGNMENT;
  }
  return { ...header, arrays, shapes };
}
