# SPDX-License-Identifier: Apache-2.0
"""A construct for every array, map and extension object that the schema files describe."""
import glob
import json
import os

from assets import FRESH, base, link, merged, text_of


class Schemas:
    def __init__(self, folder):
        self.documents = {}
        for path in sorted(glob.glob(os.path.join(folder, "*", "*.schema.json"))):
            with open(path, encoding="utf-8") as file:
                document = json.load(file)
            self.documents[document["$id"]] = document

    def resolve(self, reference, document):
        name, _, pointer = reference.partition("#")
        if name:
            document = self.documents[name]
        schema = document
        for part in pointer.split("/")[1:]:
            schema = schema[part]
        return schema, document

    def flat(self, schema, document, depth=0):
        """The schema with references, allOf and the first alternative put into it."""
        schema = {True: {}, False: {"not": {}}}[schema] if isinstance(schema, bool) else schema
        result, owner = dict(schema), document
        parts = []
        if "$ref" in schema:
            target, owner = self.resolve(schema["$ref"], document)
            parts.append((target, owner))
        parts += [(part, document) for part in schema.get("allOf", [])]
        for word in ("anyOf", "oneOf"):
            parts += [(part, document) for part in schema.get(word, [])[:1]]
        if depth > 20:
            return result, owner
        for part, home in parts:
            more, owner_of_part = self.flat(part, home, depth + 1)
            owner = owner_of_part if "$ref" in schema else owner
            for key, value in more.items():
                if key == "properties":
                    result[key] = {**value, **result.get(key, {})}
                elif key == "required":
                    result[key] = result.get(key, []) + value
                else:
                    result.setdefault(key, value)
        return result, owner

    def example(self, schema, document, number, depth=0):
        """A small value; `number` tells examples apart, None keeps them alike."""
        schema, document = self.flat(schema, document)
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return schema["enum"][0]
        kind = schema.get("type", "object" if "properties" in schema else "number")
        kind = kind[0] if isinstance(kind, list) else kind
        if kind == "object":
            names = [] if depth > 12 else dict.fromkeys(schema.get("required", []))
            properties = schema.get("properties", {})
            value = {name: self.example(properties.get(name, {}), document, number, depth + 1)
                     for name in names}
            if not value and isinstance(schema.get("additionalProperties"), dict) and depth < 12:
                value["x"] = self.example(schema["additionalProperties"], document, number, depth + 1)
            return value
        if kind == "array":
            items = schema.get("items", {})
            return [self.example(items, document, number, depth + 1)
                    for _ in range(min(schema.get("minItems", 0), 16))] if depth < 12 else []
        if kind == "string":
            return "x" if number is None else f"x{number}"
        if kind == "boolean":
            return True
        if number is not None and "ref" in schema.get("x-gltfx", {}):
            return number
        return schema.get("default", schema.get("minimum", 0))


class Walk:
    """Names and builders of constructs. A builder takes n and gives the bytes of an asset."""

    def __init__(self, schemas):
        self.schemas = schemas
        self.found = {}
        self.walked = set()  # definitions of the schema file at hand: each is walked at its first use

    def add(self, name, build):
        modes = [("alike", False), ("numbered", True)]
        if build(3, False) == build(3, True):
            modes = modes[:1]
        for mode, numbered in modes:
            self.found[f"{name} {mode}"] = lambda n, numbered=numbered: build(n, numbered)

    def lists(self, name, schema, document, put):
        """`put(value)` makes an asset out of a value for this schema."""
        if not isinstance(schema, dict):
            return  # true, which allows any value, or false
        if "$ref" in schema:
            home, _, pointer = schema["$ref"].partition("#")
            definition = (home or document["$id"], pointer)
            if definition in self.walked:
                return
            self.walked.add(definition)
        schema, document = self.schemas.flat(schema, document)
        schemas = self.schemas
        if "items" in schema:
            items = schema["items"]
            self.add(name, lambda n, numbered: put(
                [schemas.example(items, document, i if numbered else None) for i in range(n)]))
            self.lists(name + "[]", items, document, lambda value: put([value]))
        for word in ("additionalProperties", "patternProperties"):
            values = schema.get(word)
            if word == "patternProperties" and values:
                values = next(iter(values.values()))
            if not isinstance(values, dict):
                continue
            self.add(name + "{}", lambda n, numbered, values=values: put(
                {f"_K{i}": schemas.example(values, document, i if numbered else None)
                 for i in range(n)}))
            self.lists(name + "{}", values, document, lambda value: put({"_K": value}))
        whole = None
        for key, member in schema.get("properties", {}).items():
            whole = whole if whole is not None else schemas.example(schema, document, None)
            self.lists(f"{name}.{key}", member, document,
                       lambda value, key=key, whole=whole: put({**whole, key: value}))

    def core(self):
        root = self.schemas.documents["gltfx:core/glTF"]
        for key, member in root["properties"].items():
            self.lists(key, member, root,
                       lambda value, key=key: finished(merged(base(), {key: value})))

    def extension(self, document):
        words = document["x-gltfx"]
        name = words["extension"]
        places = words["on"]
        if isinstance(places, list):
            places = {place: "" for place in places}
        for place, pointer in places.items():
            if not is_place(place):
                continue
            schema = document if not pointer else self.schemas.resolve(pointer, document)[0]
            self.walked = set()
            self.lists(f"{name} on {place}", schema, document,
                       lambda value, place=place: with_extension(name, place, [value]))
            if place not in ("glTF", "asset"):
                self.add(f"{name} on many {place}", lambda n, numbered, place=place, schema=schema:
                         with_extension(name, place,
                                        [self.schemas.example(schema, document,
                                                              i if numbered else None)
                                         for i in range(n)]))


# The member of a material that holds each kind of texture info.
TEXTURE_INFOS = {"textureInfo": "emissiveTexture", "material.normalTextureInfo": "normalTexture",
                 "material.occlusionTextureInfo": "occlusionTexture"}


def is_place(place):
    """Whether with_extension() has such objects: not those of other extensions."""
    return (place in FRESH or place in ("glTF", "asset", "mesh.primitive", "animation.channel.target") or
            place in TEXTURE_INFOS)


def finished(asset):
    return text_of(link(asset, base()))


def texture_infos(kind, extension, values):
    return [{TEXTURE_INFOS[kind]: {"index": 0, "extensions": {extension: value}}} for value in values]


def with_extension(name, place, values):
    """An asset in which each value is an object of the extension `name` at such a place."""
    asset = base()
    asset["extensionsUsed"].append(name)
    objects = [{name: value} for value in values]
    if place in ("glTF", "asset"):
        holder = asset if place == "glTF" else asset["asset"]
        holder["extensions"] = objects[0]
    elif place in TEXTURE_INFOS:
        asset["materials"] += texture_infos(place, name, values)
    elif place == "mesh.primitive":
        drawn = asset["meshes"][0]["primitives"][0]
        asset["meshes"].append({"primitives": [{**drawn, "extensions": each} for each in objects]})
    elif place == "animation.channel.target":
        channel = {"sampler": 0, "target": {"path": "pointer"}}
        asset["animations"].append({
            "samplers": asset["animations"][0]["samplers"],
            "channels": [{**channel, "target": {"path": "pointer", "extensions": each}}
                         for each in objects]})
    else:
        array, fresh = FRESH[place]
        asset[array] += [{**fresh(), "extensions": each} for each in objects]
    return finished(asset)


def constructs(folder):
    schemas = Schemas(folder)
    walk = Walk(schemas)
    walk.core()
    for name, document in schemas.documents.items():
        if name.startswith("gltfx:ext/"):
            walk.extension(document)
    return walk.found
