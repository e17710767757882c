"""A depth renderer in numpy with the interface that bop_toolkit's error functions call.

The toolkit's own renderers need OpenGL. Pixel (u, v) is the ray ((u - cx) / fx, (v - cy) / fy, 1), both sides of a
triangle are drawn.
"""
import numpy as np

NUMBERS = {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4", "uint": "<u4"}


def load_ply(path):
    """Vertices (n, 3) and triangles (m, 3) of a binary little-endian PLY file."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    counts, properties, element = {}, {}, None
    for line in data[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element], properties[element] = int(words[2]), []
        elif words[0] == "property":
            properties[element].append(words[1:])
    vertex_type = np.dtype([(p[-1], NUMBERS[p[0]]) for p in properties["vertex"]])
    vertices = np.frombuffer(data, vertex_type, counts["vertex"], end)
    (face,) = properties["face"]
    face_type = np.dtype([("count", NUMBERS[face[1]]), ("corners", NUMBERS[face[2]], (3,))])
    faces = np.frombuffer(data, face_type, counts["face"], end + vertices.nbytes)
    assert face[0] == "list" and (faces["count"] == 3).all(), f"{path}: triangles only"
    return np.stack([vertices[axis] for axis in "xyz"], 1).astype(float), faces["corners"].astype(int)


class SoftwareRenderer:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.models, self.known = {}, {}

    def add_object(self, obj_id, model_path):
        self.models[obj_id] = load_ply(model_path)

    def render_object(self, obj_id, R, t, fx, fy, cx, cy):
        key = (obj_id, R.tobytes(), t.tobytes(), fx, fy, cx, cy)
        if key not in self.known:
            if len(self.known) > 64:
                self.known.pop(next(iter(self.known)))
            self.known[key] = self._draw(*self.models[obj_id], R, t.reshape(3), fx, fy, cx, cy)
        return {"depth": self.known[key].copy()}

    def _draw(self, vertices, triangles, R, t, fx, fy, cx, cy):
        points = vertices @ R.T + t
        u = (fx * points[:, 0] / points[:, 2] + cx)[triangles]
        v = (fy * points[:, 1] / points[:, 2] + cy)[triangles]
        nearness = (1.0 / points[:, 2])[triangles]
        area = (u[:, 1] - u[:, 0]) * (v[:, 2] - v[:, 0]) - (u[:, 2] - u[:, 0]) * (v[:, 1] - v[:, 0])
        left = np.maximum(np.ceil(u.min(1)), 0).astype(int)
        right = np.minimum(np.floor(u.max(1)), self.width - 1).astype(int)
        top = np.maximum(np.ceil(v.min(1)), 0).astype(int)
        bottom = np.minimum(np.floor(v.max(1)), self.height - 1).astype(int)
        size = np.maximum(right - left, bottom - top) + 1
        order = np.nonzero((np.abs(area) > 1e-12) & (right >= left) & (bottom >= top))[0]
        order = order[np.argsort(size[order], kind="stable")]
        image = np.zeros(self.width * self.height)  # The largest 1 / z of each pixel.
        while len(order):  # Batches of triangles of similar size.
            limit = int(np.ceil(size[order[0]] * 1.3))
            count = min(np.searchsorted(size[order], limit, side="right"), max(1, 4_000_000 // limit**2))
            batch, order = order[: max(count, 1)], order[max(count, 1) :]
            dx, dy = np.meshgrid(*[np.arange(size[batch].max())] * 2)
            x = left[batch][:, None] + dx.ravel()
            y = top[batch][:, None] + dy.ravel()
            inside = (x <= right[batch][:, None]) & (y <= bottom[batch][:, None])
            value = np.zeros(x.shape)
            for corner, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
                weight = (
                    (u[batch, i][:, None] - x) * (v[batch, j][:, None] - y)
                    - (u[batch, j][:, None] - x) * (v[batch, i][:, None] - y)
                ) / area[batch][:, None]
                inside &= weight >= -1e-9
                value += weight * nearness[batch, corner][:, None]
            np.maximum.at(image, (y * self.width + x)[inside], value[inside])
        depth = np.divide(1.0, image, out=np.zeros_like(image), where=image > 0)
        return depth.reshape(self.height, self.width)
