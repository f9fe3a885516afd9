# SPDX-License-Identifier: Apache-2.0
"""Valid and invalid values, made from the schema file of an extension; jsonschema tells them apart."""
import copy
import json
import re

import jsonschema

NUMBERS = [0, 1, 2, 0.5, 3, 4, 16, 100, -1]
STRINGS = ["x", "x1", "A", "_FEATURE_ID_0", "r", "rgba", "image/png", "1.0", "2020-01-01", "x/y", "/nodes/0/rotation",
           "https://example.org/x", "https://vrm.dev/x", "video/mp4", "GEOD", "0"]
ODD = [None, True, False, -1, 0, 0.5, 1, 2, 1e9, "", "x", "?", [], [1], [-1], [0.5], ["x"], [[1]], [{}], {},
       {"x": 1}]
FREE_NAMES = ["x", "POSITION"]  # of members that a schema does not list; the second one is required elsewhere
MOST_REPEATS = 40  # elements that an array is made too long with


# The only format that is checked.
FORMATS = jsonschema.FormatChecker(formats=[])


@FORMATS.checks("json-pointer")
def is_json_pointer(text):
    return not isinstance(text, str) or re.fullmatch(r"(/([^~/]|~[01])*)*", text) is not None


class Oracle:
    """The schema files as one document that any JSON Schema validator can read."""

    def __init__(self, documents):
        self.definitions = {self.key(name): self.plain(document, name)
                            for name, document in documents.items()}
        self.validators = {}

    @staticmethod
    def key(name):
        return name.replace("/", ".")

    def plain(self, value, name):
        if isinstance(value, list):
            return [self.plain(each, name) for each in value]
        if not isinstance(value, dict):
            return value
        result = {}
        for word, each in value.items():
            if word in ("$id", "$schema", "x-gltfx"):
                continue
            if word == "$ref" and isinstance(each, str):
                owner, _, pointer = each.partition("#")
                result[word] = f"#/$defs/{self.key(owner or name)}{pointer}"
            else:
                result[word] = self.plain(each, name)
        return result

    def valid(self, schema, name, value):
        mark = (id(schema), name)
        if mark not in self.validators:
            whole = {"allOf": [self.plain(schema, name)], "$defs": self.definitions}
            self.validators[mark] = (schema, jsonschema.Draft202012Validator(whole, format_checker=FORMATS))
        return self.validators[mark][1].is_valid(value)


class Examples:
    def __init__(self, schemas, oracle):
        self.schemas, self.oracle = schemas, oracle

    def of(self, schema, document, depth=0):
        """Valid values, the fullest first; none if no guess fits."""
        flat, owner = self.schemas.flat(schema, document)
        guesses = self.guesses(flat, owner, depth)
        return [each for each in guesses if self.oracle.valid(schema, document["$id"], each)]

    def guesses(self, flat, owner, depth):
        if "const" in flat:
            return [flat["const"]]
        if "enum" in flat:
            return flat["enum"]
        kind = flat.get("type", "object" if "properties" in flat else "number")
        kind = kind[0] if isinstance(kind, list) else kind
        if kind == "object":
            return self.objects(flat, owner, depth)
        if kind == "array":
            return self.arrays(flat, owner, depth)
        if kind == "string":
            return STRINGS
        if kind == "boolean":
            return [True]
        limits = [flat[word] for word in ("default", "minimum", "maximum") if word in flat]
        return limits + [each + step for each in limits for step in (1, -1)] + NUMBERS

    def arrays(self, flat, owner, depth):
        items = self.of(flat["items"], owner, depth + 1) if "items" in flat and depth < 12 else [0]
        few = flat.get("minItems", 0)
        most = min(flat.get("maxItems", MOST_REPEATS), MOST_REPEATS)
        lengths = [length for length in (max(few, 1), few, 2, 3) if few <= length <= most]
        found = [[copy.deepcopy(each) for _ in range(length)] for length in lengths for each in items[:1]]
        found += [[copy.deepcopy(each) for _ in range(max(few, 1))] for each in items[1:8]]
        return found + [items[:max(few, 1)], [], flat.get("default")]

    def objects(self, flat, owner, depth):
        members = {name: self.of(member, owner, depth + 1)
                   for name, member in flat.get("properties", {}).items()} if depth < 12 else {}
        free = flat.get("additionalProperties")
        if isinstance(free, dict) and depth < 12:
            for each in self.of(free, owner, depth + 1)[:1]:
                for name in FREE_NAMES:
                    members.setdefault(name, [each])
        for pattern, member in flat.get("patternProperties", {}).items():
            for each in self.of(member, owner, depth + 1)[:1]:
                for name in STRINGS:
                    if self.oracle.valid({"pattern": pattern}, owner["$id"], name):
                        members.setdefault(name, [each])
                        break
        fits = lambda value: self.oracle.valid(flat, owner["$id"], value)  # noqa: E731
        found = []
        # Forms that begin with each member, and grow as long as they stay valid.
        for first in [None, *members]:
            start = self.started(flat, members, first, fits)
            if start is None:
                continue
            small = copy.deepcopy(start)
            for name, values in members.items():
                for value in values[:1]:
                    if name not in start and fits({**start, name: value}):
                        start[name] = copy.deepcopy(value)
            found += [each for each in (start, small) if each not in found]
            # Other forms of one member of it.
            for name, values in members.items():
                for value in values[1:20]:
                    other = {**start, name: copy.deepcopy(value)}
                    if name in start and other not in found and fits(other):
                        found.append(other)
        return found

    @staticmethod
    def started(flat, members, first, fits):
        """The smallest valid object with the member `first`, as far as it is found by adding."""
        names = [name for name in flat.get("required", []) if name in members]
        names += [first] if first is not None and first not in names else []
        start = {name: copy.deepcopy(members[name][0]) for name in names if members[name]}
        choices = [{}] + [{name: value} for name, values in members.items() for value in values[:20]]
        for more in choices:
            if fits({**start, **more}):
                return {**start, **more}
        for more in choices:
            for still in choices:
                if fits({**start, **more, **still}):
                    return {**start, **more, **still}
        return None


def numbers_of(schema):
    """Values at and beside the limits that a schema file states, and one beside each list."""
    found = []
    stack = [schema]
    while stack:
        each = stack.pop()
        if isinstance(each, dict):
            for word in ("minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"):
                limit = each.get(word)
                if isinstance(limit, (int, float)) and not isinstance(limit, bool) and abs(limit) < 1e6:
                    found += [limit, limit - 1, limit + 1, limit + 0.5]
            if isinstance(each.get("enum"), list):
                found += [each["enum"][0], str(each["enum"][0]) + "_"]
            stack += each.values()
        elif isinstance(each, list):
            stack += each
    unique = {json.dumps(value): value for value in found}
    return list(unique.values())[:24]


def places(value, path=()):
    yield path, value
    if isinstance(value, dict):
        for name, each in value.items():
            yield from places(each, (*path, name))
    elif isinstance(value, list):
        for index, each in enumerate(value[:3]):
            yield from places(each, (*path, index))


def changed(whole, path, new):
    if not path:
        return new
    whole = copy.deepcopy(whole)
    holder = whole
    for step in path[:-1]:
        holder = holder[step]
    holder[path[-1]] = new
    return whole


def changes(whole, odd):
    """The value with each of its parts changed."""
    for path, value in places(whole):
        for new in odd:
            yield changed(whole, path, new)
        if isinstance(value, dict):
            for name in value:
                yield changed(whole, path, {key: each for key, each in value.items() if key != name})
                yield changed(whole, path, {("?" if key == name else key): each for key, each in value.items()})
        if isinstance(value, list) and value:
            for new in (value[:-1], [*value, value[0]], value * 2, (value * MOST_REPEATS)[:MOST_REPEATS]):
                yield changed(whole, path, new)


def cases(schema, document, examples, most):
    """(value, whether it is valid) for a schema of a file; whether there is any valid one."""
    bases = examples.of(schema, document)[:40]
    odd = ODD + numbers_of(document)
    seen = set()
    found = []

    def add(value):
        text = json.dumps(value, sort_keys=True)
        if text not in seen:
            seen.add(text)
            found.append((value, examples.oracle.valid(schema, document["$id"], value)))

    for base in bases:
        add(base)
    for base in bases:
        for value in changes(base, odd):
            if len(found) >= most:
                return found, True
            add(value)
    return found, bool(bases)
