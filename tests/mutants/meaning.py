# SPDX-License-Identifier: Apache-2.0
"""The meaning of an asset, read without code of gltfx: whether a changed asset has the same.

losses(before, after) lists what is missing or different in the second of two assets, but for what has no meaning:
bounds, targets of buffer views, unused members and those that are null, quotes around a number, names of extensions
that nothing uses, the length of what is a direction. Names, extras, unknown extensions, materials, values of accessors and bytes of images have to stay.
"""
import base64
import decimal
import json
import math
import struct
import urllib.parse

FORMS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
COUNTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
MOST = 1 << 20  # elements
DIRECTIONS = ("NORMAL", "TANGENT", "rotation", "ROTATION", "KHR_gaussian_splatting:ROTATION")
TRANSFORM = ("matrix", "translation", "rotation", "scale")


class Object(dict):
    """Members by name, and all values of a repeated name."""

    def __init__(self, pairs):
        super().__init__(pairs)
        self.repeats = {}
        if len(self) != len(pairs):
            for key, value in pairs:
                self.repeats.setdefault(key, []).append(value)
            self.repeats = {key: values for key, values in self.repeats.items() if len(values) > 1}


def parsed(text):
    return json.loads(text, object_pairs_hook=Object, parse_float=decimal.Decimal)


class Asset:
    def __init__(self, text, binary, file):
        """`file`: gives the bytes of a path, or None."""
        self.document, self.binary, self.file = parsed(text), binary, file
        self.contents = {}

    def list(self, name):
        found = self.document.get(name) if isinstance(self.document, dict) else None
        return found if isinstance(found, list) else []

    def resource(self, uri):
        """The bytes that a URI leads to, or None."""
        if not isinstance(uri, str):
            return None
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.split(",", 1)[1])
            except (IndexError, ValueError):
                return None
        return self.file(urllib.parse.unquote(uri).replace("\\", "/"))

    def buffer(self, index):
        if index not in self.contents:
            buffer = self.list("buffers")[index]
            self.contents[index] = self.binary if buffer.get("uri") is None else self.resource(buffer["uri"])
        return self.contents[index]

    def view(self, index):
        """Bytes of a buffer view and its stride."""
        view = self.list("bufferViews")[index]
        if "extensions" in view:
            raise ValueError("compressed")
        data = self.buffer(view["buffer"])
        begin = view.get("byteOffset", 0)
        end = begin + view["byteLength"]
        if not 0 <= begin <= end <= len(data):
            raise ValueError("outside")
        return data[begin:end], view.get("byteStride")

    def elements(self, index):
        """The elements of an accessor as tuples; None if they are unknown."""
        try:
            return self.read_elements(self.list("accessors")[index])
        except (AttributeError, IndexError, KeyError, TypeError, ValueError, struct.error, OverflowError):
            return None

    def read_elements(self, accessor):
        kind, component, count = accessor["type"], FORMS[accessor["componentType"]], accessor["count"]
        if not 0 < count <= MOST or "extensions" in accessor:
            return None
        form = "<" + component * COUNTS[kind]
        size = struct.calcsize(form)
        columns = {"MAT2": 2, "MAT3": 3}.get(kind, 0)
        if columns and columns * struct.calcsize(component) % 4:
            return None  # columns with padding
        values = [(0,) * COUNTS[kind]] * count
        if accessor.get("bufferView") is not None:
            data, stride = self.view(accessor["bufferView"])
            stride, at = stride or size, accessor.get("byteOffset", 0)
            if stride < size:
                return None  # overlapping elements are not values: gltfx draws none of them
            values = [struct.unpack_from(form, data, at + i * stride) for i in range(count)]
        sparse = accessor.get("sparse")
        if sparse:
            indices, _ = self.view(sparse["indices"]["bufferView"])
            replaced, _ = self.view(sparse["values"]["bufferView"])
            step = "<" + FORMS[sparse["indices"]["componentType"]]
            for i in range(sparse["count"]):
                at = struct.unpack_from(step, indices, sparse["indices"].get("byteOffset", 0) +
                                        i * struct.calcsize(step))[0]
                values[at] = struct.unpack_from(form, replaced, sparse["values"].get("byteOffset", 0) + i * size)
        return values

    def roles(self):
        """By accessor: its use, and the primitives that use it."""
        roles, users = {}, {}

        def note(index, role):
            if isinstance(index, int):
                roles.setdefault(index, set()).add(role)

        for mesh in self.list("meshes"):
            for primitive in objects(mesh, "primitives"):
                attributes = primitive.get("attributes")
                for name, index in (attributes if isinstance(attributes, dict) else {}).items():
                    note(index, name)
                    if isinstance(index, int):
                        users.setdefault(index, []).append(primitive)
        for node in self.list("nodes"):
            attributes = find(node, "extensions", "EXT_mesh_gpu_instancing", "attributes")
            for name, index in (attributes if isinstance(attributes, dict) else {}).items():
                note(index, name)
        for animation in self.list("animations"):
            samplers = objects(animation, "samplers")
            for channel in objects(animation, "channels"):
                sampler = channel.get("sampler")
                path = find(channel, "target", "path")
                if isinstance(sampler, int) and 0 <= sampler < len(samplers) and isinstance(path, str):
                    note(samplers[sampler].get("output"), path)
        return roles, users


def find(value, *names):
    for name in names:
        value = value.get(name) if isinstance(value, dict) else None
    return value


def objects(holder, name):
    found = find(holder, name)
    return [one for one in found if isinstance(one, dict)] if isinstance(found, list) else []


# Values of accessors ------------------------------------------------------------------------------------------

def is_finite(element):
    return all(math.isfinite(number) for number in element)


def same_direction(one, other):
    one, other = one[:4 if len(one) == 4 else 3], other[:4 if len(other) == 4 else 3]
    lengths = math.hypot(*one) * math.hypot(*other)
    return lengths > 0 and sum(a * b for a, b in zip(one, other)) > (1 - 1e-5) * lengths


def same_element(role, one, other):
    """Whether the meaning of an element in a role is unchanged."""
    if one == other or (not is_finite(one) and not is_finite(other)):
        return True
    if not is_finite(one) or not is_finite(other):
        return False
    if role == "TANGENT":
        return same_direction(one[:3], other[:3]) and one[3] * other[3] > 0
    if role in DIRECTIONS:
        return same_direction(one, other)
    if role.startswith("WEIGHTS"):
        total = sum(one)
        return total > 0 and abs(total - 1) <= 0.0501 and \
            all(abs(a / total - b) < 1e-5 for a, b in zip(one, other))
    return all(abs(a - b) <= 1 / 512 for a, b in zip(one, other)) and all(0 <= b <= 1 for b in other)


def without_weight(asset, users, index, role, element, component):
    """Whether the joint of a vertex has no weight in any primitive."""
    if not role.startswith("JOINTS_"):
        return False
    for primitive in users.get(index, []):
        weights = asset.elements(primitive["attributes"].get(role.replace("JOINTS", "WEIGHTS"), -1))
        if not weights or element >= len(weights) or weights[element][component] != 0:
            return False
    return True


def drawn(asset, users, index, element):
    for primitive in users.get(index, []):
        if primitive.get("indices") is None:
            return True
        indices = asset.elements(primitive["indices"])
        if indices is None or (element,) in indices:
            return True
    return not users.get(index)


def changed_values(before, after):
    roles, users = before.roles()
    for index in range(len(before.list("accessors"))):
        old, new = before.elements(index), after.elements(index)
        if old is None or old == new:
            continue
        if new is None or len(old) != len(new):
            yield f"accessor {index}: its elements are gone"
            continue
        for i, (one, other) in enumerate(zip(old, new)):
            if one == other or all(same_element(role, one, other) for role in roles.get(index, {"none"})):
                continue
            joints = all(b == 0 and all(without_weight(before, users, index, role, i, c)
                                        for role in roles.get(index, {"none"}))
                         for c, (a, b) in enumerate(zip(one, other)) if a != b)
            if joints or not (is_finite(one) or drawn(before, users, index, i)):
                continue
            yield f"accessor {index}, element {i}: {one} is {other}"
            break


# The document -------------------------------------------------------------------------------------------------

def local_matrix(node):
    """The drawn transform: the matrix if there is a valid one."""
    def numbers(name, count, usual):
        value = node.get(name)
        sound = isinstance(value, list) and len(value) == count and \
            all(isinstance(v, (int, decimal.Decimal)) and not isinstance(v, bool) for v in value)
        return [float(v) for v in value] if sound else usual
    matrix = numbers("matrix", 16, None)
    if matrix:
        return matrix
    (tx, ty, tz), (sx, sy, sz) = numbers("translation", 3, [0, 0, 0]), numbers("scale", 3, [1, 1, 1])
    x, y, z, w = numbers("rotation", 4, [0, 0, 0, 1])
    if max(map(abs, (x, y, z, w))) > 1:
        x, y, z, w = 0, 0, 0, 1
    length = math.hypot(x, y, z, w)
    x, y, z, w = (v / length for v in (x, y, z, w)) if length else (0, 0, 0, 1)
    return [sx * (1 - 2 * (y * y + z * z)), sx * 2 * (x * y + z * w), sx * 2 * (x * z - y * w), 0,
            sy * 2 * (x * y - z * w), sy * (1 - 2 * (x * x + z * z)), sy * 2 * (y * z + x * w), 0,
            sz * 2 * (x * z + y * w), sz * 2 * (y * z - x * w), sz * (1 - 2 * (x * x + y * y)), 0, tx, ty, tz, 1]


def same_transform(one, other):
    if not (isinstance(one, dict) and isinstance(other, dict)):
        return False
    return all(abs(a - b) <= 1e-5 * max(1, abs(a)) for a, b in zip(local_matrix(one), local_matrix(other)))


def uses(value, extension):
    stack = [value]
    while stack:
        value = stack.pop()
        if isinstance(value, dict):
            if isinstance(value.get("extensions"), dict) and extension in value["extensions"]:
                return True
            stack += value.values()
        elif isinstance(value, list):
            stack += value
    return False


def below(document, node):
    """Indices of the nodes below one."""
    nodes, found, stack = document.get("nodes", []), set(), [node]
    while stack:
        at = stack.pop()
        children = find(nodes[at], "children") if isinstance(at, int) and 0 <= at < len(nodes) else None
        for child in children if isinstance(children, list) else []:
            if isinstance(child, int) and child not in found:
                found.add(child)
                stack.append(child)
    return found


def kept_list(document, path, old, new):
    """Whether a list of another length lacks only what was there before, or is drawn below what was."""
    if path[-1] in ("extensionsUsed", "extensionsRequired"):
        gone = {name for name in old if isinstance(name, str)} - {name for name in new if isinstance(name, str)}
        return path[-1] == "extensionsRequired" or not any(uses(document, name) for name in gone)
    left, seen = list(new), []
    for one in old:
        if left and left[0] == one:
            seen.append(left.pop(0))
        elif one not in seen and not any(one in below(document, root) for root in seen):
            return False
    return not left


class Comparison:
    def __init__(self, before, after):
        self.before, self.after, self.found = before, after, []

    def tell(self, path, what):
        self.found.append(f"/{'/'.join(map(str, path))}: {what}")

    def compare(self, old, new, path=(), holders=()):
        kept = "extras" in path  # whatever it is
        if isinstance(old, dict) and isinstance(new, dict):
            self.members(old, new, path, holders + ((old, new),))
        elif isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
            for i, (one, other) in enumerate(zip(old, new)):
                self.compare(one, other, path + (i,), holders)
        elif isinstance(old, list) and isinstance(new, list) and not kept:
            is_fixed_bound = path[0] == "accessors" and path[-1] in ("min", "max") and self.is_bound(path[-1], path)
            if not is_fixed_bound and not kept_list(self.before.document, path, old, new):
                self.tell(path, f"{old} is {new}")
        elif type(old) is not type(new) and {type(old), type(new)} != {int, decimal.Decimal} or old != new:
            if kept or not self.may_change(old, new, path, holders):
                self.tell(path, f"{str(old)[:80]} is {str(new)[:80]}")

    def members(self, old, new, path, holders):
        for key, values in old.repeats.items():
            values_now = new.repeats.get(key, [new[key]] if key in new else [])
            if any(value != values[-1] for value in values) and any(value not in values_now for value in values):
                self.tell(path + (key,), "one of several values is gone")
        added = [key for key in new if key not in old]
        for key, value in old.items():
            if key in new:
                self.compare(value, new[key], path + (key,), holders)
            elif "extras" in path or not (any(new[name] == value for name in added) or
                                          self.may_go(key, value, path, holders)):
                self.tell(path + (key,), f"{str(value)[:80]} is gone")

    def may_go(self, key, value, path, holders):
        old, new = holders[-1]
        if value is None or value in ([], {}) or key in ("byteStride", "target", "extensionsUsed", "extensionsRequired"):
            return key not in ("extras",)
        if key in TRANSFORM:
            return same_transform(old, new)
        if key == "alphaCutoff":
            return old.get("alphaMode") != "MASK"
        if key == "iridescenceThicknessMinimum":
            return "iridescenceThicknessTexture" not in old
        if key == "node" and path[-1:] == ("target",):
            return find(old, "extensions", "KHR_animation_pointer") is not None
        return key in ("normalized",) or (key == "weights" and path[:1] == ("meshes",))

    def may_change(self, old, new, path, holders):
        key = next((step for step in reversed(path) if isinstance(step, str)), "")
        if isinstance(old, str) != isinstance(new, str) and not isinstance(old, bool) and str(old) == str(new):
            return True  # a number in quotes, or without them
        if key in TRANSFORM:
            return same_transform(*holders[-1])
        if key == "uri":
            return self.before.resource(old) in (None, self.after.resource(new)) or path[0] == "buffers"
        if key == "mimeType":
            return new in ("image/png", "image/jpeg", "image/webp", "image/ktx2")
        if key in ("min", "max"):
            return self.is_bound(key, path)
        return key in ("target",) or (key == "byteLength" and path[0] == "buffers")

    def is_bound(self, key, path):
        elements = self.after.elements(path[1])
        if path[0] != "accessors" or elements is None:
            return path[0] == "accessors"  # compressed
        least = tuple(map(min if key == "min" else max, zip(*elements)))
        bound = find(self.after.list("accessors")[path[1]], key)
        return all(abs(float(a) - b) <= 1e-6 * max(1, abs(b)) for a, b in zip(bound, least))


def finds_more(before, after):
    """Whether the path of a file or the place of elements was corrected: the picture may have more, too."""
    for array in ("buffers", "images"):
        for old, new in zip(before.list(array), after.list(array)):
            uri = find(old, "uri")
            if isinstance(uri, str) and not uri.startswith("data:") and uri != find(new, "uri"):
                return True
    return any(before.elements(i) is None and after.elements(i) is not None
               for i in range(len(before.list("accessors"))))


def losses(before, after):
    comparison = Comparison(before, after)
    comparison.compare(before.document, after.document)
    return comparison.found + list(changed_values(before, after))
