"""Reads and writes the PLY files that the programs and data/ hold. Needs numpy."""
import numpy as np

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}


def _header(file, path):
    """Returns the byte order and [(element, count, [(property, type, type of count or None)])]."""
    if file.readline().strip() != b"ply":
        raise ValueError(f"{path}: no PLY file")
    order, elements = None, []
    while True:
        line = file.readline()
        if not line:
            raise ValueError(f"{path}: the header has no end")
        words = line.decode("latin-1").split()
        if not words:
            continue
        if words[0] == "format":
            order = {"binary_little_endian": "<", "binary_big_endian": ">"}.get(words[1])
            if order is None:
                raise ValueError(f"{path}: format {words[1]}, expected a binary one")
        elif words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property" and words[1] == "list":
            elements[-1][2].append((words[4], _TYPES[words[3]], _TYPES[words[2]]))
        elif words[0] == "property":
            elements[-1][2].append((words[2], _TYPES[words[1]], None))
        elif words[0] == "end_header":
            return order, elements


def read_ply(path):
    """Returns {element: structured array} of a binary PLY; lists must hold three entries (triangles)."""
    with open(path, "rb") as file:
        order, elements = _header(file, path)
        result = {}
        for name, count, properties in elements:
            fields = []
            for prop, value, counter in properties:
                if counter is None:
                    fields.append((prop, order + value))
                else:
                    fields += [(prop + "_count", order + counter), (prop, order + value, (3,))]
            dtype = np.dtype(fields)
            data = file.read(count * dtype.itemsize)
            if len(data) < count * dtype.itemsize:
                raise ValueError(f"{path}: ends within element {name}")
            array = np.frombuffer(data, dtype, count)
            for prop, _, counter in properties:
                if counter is not None and np.any(array[prop + "_count"] != 3):
                    raise ValueError(f"{path}: {name} has a {prop} that isn't a triangle")
            result[name] = array
        return result


def points(ply):
    """Returns the vertices of read_ply(), N x 3 doubles."""
    vertex = ply["vertex"]
    return np.stack([vertex[axis].astype(float) for axis in "xyz"], axis=1)


def triangles(ply):
    """Returns the faces of read_ply(), M x 3 integers; none where there are none."""
    face = ply.get("face")
    if face is None or not face.dtype.names:
        return np.zeros((0, 3), int)
    name = next(n for n in face.dtype.names if n in ("vertex_indices", "vertex_index"))
    return face[name].astype(int)


def write_ply(path, points, triangles):
    """Writes a binary PLY of N x 3 points, as floats, and M x 3 triangles."""
    face = np.zeros(len(triangles), [("count", "u1"), ("indices", "<i4", (3,))])
    face["count"], face["indices"] = 3, triangles
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}",
              *(f"property float {axis}" for axis in "xyz"), f"element face {len(triangles)}",
              "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode() + points.astype("<f4").tobytes() + face.tobytes())


def subdivide(points, triangles):
    """Returns points and triangles with a point amid every edge: four triangles for each."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                    triangles[:, [2, 0]]]), axis=1)
    edges, of_side = np.unique(sides, axis=0, return_inverse=True)
    ab, bc, ca = (len(points) + of_side).reshape(3, -1)
    a, b, c = triangles.T
    finer = np.concatenate([np.stack(corners, axis=1) for corners in
                            ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return np.concatenate([points, 0.5 * (points[edges[:, 0]] + points[edges[:, 1]])]), finer
