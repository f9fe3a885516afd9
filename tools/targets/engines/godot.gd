# SPDX-License-Identifier: Apache-2.0
# A plugin of Godot's editor: imports the assets of the project whose paths come in the file `asked`, and prints the
# nodes and resources that Godot makes of each.
tool
extends EditorPlugin

const MODES = [0, 1, 3, 2, 4, 5, 6]
const ATTRIBUTES = {Mesh.ARRAY_VERTEX: "POSITION", Mesh.ARRAY_NORMAL: "NORMAL", Mesh.ARRAY_TEX_UV: "TEXCOORD_0",
	Mesh.ARRAY_TEX_UV2: "TEXCOORD_1", Mesh.ARRAY_COLOR: "COLOR_0"}
const SKIPPED = ["resource_path", "resource_name", "resource_local_to_scene", "script", "owner", "filename", "multiplayer", "load_path", "root_node"]

var files
var asked = ""
var ready = false
var imported = {}
var seen = {}  # of an asset: numbers of resources
var lines = []
var generated = RegEx.new()


func _ready():
	generated.compile("@[0-9]+$")
	files = get_editor_interface().get_resource_filesystem()
	files.connect("filesystem_changed", self, "_scanned")
	files.connect("resources_reimported", self, "_imported")
	set_process(true)


# The editor calls _process() while it scans and imports, too.
func _scanned():
	ready = true


func _imported(paths):
	for path in paths:
		imported[path] = true


func _process(_delta):
	if not ready or files.is_scanning():
		return
	if asked == "":
		var file = File.new()
		if file.open("res://asked", File.READ) != OK:
			return
		asked = file.get_as_text()
		file.close()
		Directory.new().remove("res://asked")
		files.scan()
	elif asked in imported:
		var scene = load(asked)
		print("\nANSWER ", asked, "\t", JSON.print(answer(scene.instance()) if scene else {"refused": "the import fails"}))
		asked = ""


func number(value):
	return 9999.0 if is_nan(value) or is_inf(value) else stepify(value, 0.0001) + 0.0


# A value as JSON: numbers rounded, resources by number.
func plain(value):
	match typeof(value):
		TYPE_NIL, TYPE_BOOL, TYPE_INT:
			return value
		TYPE_REAL:
			return number(value)
		TYPE_VECTOR2:
			return [number(value.x), number(value.y)]
		TYPE_VECTOR3:
			return [number(value.x), number(value.y), number(value.z)]
		TYPE_QUAT, TYPE_PLANE:
			return [number(value.x), number(value.y), number(value.z), number(value.w if value is Quat else value.d)]
		TYPE_COLOR:
			return [number(value.r), number(value.g), number(value.b), number(value.a)]
		TYPE_BASIS:
			return [plain(value.x), plain(value.y), plain(value.z)]
		TYPE_TRANSFORM:
			return [plain(value.basis), plain(value.origin)]
		TYPE_DICTIONARY:
			var out = {}
			for key in value:
				out[str(key)] = plain(value[key])
			return out
		TYPE_OBJECT:
			return resource(value) if value is Resource else ""
		TYPE_ARRAY, TYPE_INT_ARRAY, TYPE_REAL_ARRAY, TYPE_STRING_ARRAY, TYPE_VECTOR2_ARRAY, TYPE_VECTOR3_ARRAY, TYPE_COLOR_ARRAY, TYPE_RAW_ARRAY:
			var out = []
			for each in value:
				out.append(plain(each))
			return out
	return str(value)


func members(thing):
	var out = {"class": thing.get_class()}
	for property in thing.get_property_list():
		# A mesh instance has weights of blend shapes as properties.
		if property.usage & PROPERTY_USAGE_STORAGE and not property.name in SKIPPED:
			out[property.name] = plain(thing.get(property.name))
	return out


func resource(it):
	if it == null:
		return null
	if not it in seen:
		seen[it] = seen.size()
		var index = seen[it]
		var out = [index, it.resource_name]
		if it is ArrayMesh:
			for i in it.get_surface_count():
				out.append([it.surface_get_primitive_type(i), plain(it.surface_get_arrays(i)), plain(it.surface_get_blend_shape_arrays(i)), plain(it.surface_get_material(i))])
			for i in it.get_blend_shape_count():
				out.append(it.get_blend_shape_name(i))
		elif it is Animation:
			out.append([it.loop, number(it.length), tracks(it)])
		elif it is Texture:
			out.append([it.flags, pixels(it)])
		elif it is Skin:
			for i in it.get_bind_count():
				out.append([it.get_bind_bone(i), it.get_bind_name(i), plain(it.get_bind_pose(i))])
		else:
			out.append(members(it))
		lines.append(out)
	return "#%d" % seen[it]


func pixels(texture):
	var image = texture.get_data()
	return [image.get_width(), image.get_height(), image.get_format(), Marshalls.raw_to_base64(image.get_data()).md5_text()] if image else []


# The colors in the middle of each quarter, in fifths: the same for lossy images, and for other sizes.
func samples(texture):
	var image = texture.get_data()
	var out = []
	if image == null or image.is_empty():
		return out
	if image.is_compressed():
		image.decompress()
	image.lock()
	for y in [1, 3]:
		for x in [1, 3]:
			var color = image.get_pixel(image.get_width() * x / 4, image.get_height() * y / 4)
			out.append([round(5 * color.r), round(5 * color.g), round(5 * color.b), round(5 * color.a)])
	image.unlock()
	return out


func tracks(animation):
	var out = []
	for i in animation.get_track_count():
		var keys = []
		for k in animation.track_get_key_count(i):
			keys.append([number(animation.track_get_key_time(i, k)), plain(animation.track_get_key_value(i, k))])
		out.append([animation.track_get_type(i), str(animation.track_get_path(i)), animation.track_get_interpolation_type(i), keys])
	return out


# A node and its children, without names that count all nodes so far.
func visit(node, found):
	var name = generated.sub(node.name, "")
	var out = [name, members(node)]
	found.names.append(name)
	if node is Spatial:
		found.nodes.append([name, plain(node.global_transform)])
	if node is MeshInstance and node.mesh:
		found.morphs.append(node.mesh.get_blend_shape_count())
		for i in node.mesh.get_surface_count():
			found.parts.append(part(node, i))
			var material = node.mesh.surface_get_material(i)
			if material is SpatialMaterial and material.albedo_texture:
				found.pixels.append(samples(material.albedo_texture))
				found.images.append(pixels(material.albedo_texture))
		found.skin.append(skinned(node))
	if node is Light:
		found.lights += 1
	if node is Skeleton:
		for i in node.get_bone_count():
			found.names.append(node.get_bone_name(i))
			out.append([node.get_bone_name(i), node.get_bone_parent(i), plain(node.get_bone_rest(i)), plain(node.get_bone_pose(i))])
	if node is AnimationPlayer:
		for animation in node.get_animation_list():
			found.animations.append(animation)
			var all = tracks(node.get_animation(animation))
			out.append([animation, resource(node.get_animation(animation))])
			for track in all:
				found.moved.append(track[1])
				found.tracks.append([track[0], track[2], track[3]])
	lines.append(out)
	for child in node.get_children():
		visit(child, found)


# One surface of a mesh, with positions in the scene.
func part(node, index):
	var arrays = node.mesh.surface_get_arrays(index)
	var attributes = {}
	for kind in ATTRIBUTES:
		if arrays[kind] != null:
			attributes[ATTRIBUTES[kind]] = plain(arrays[kind])
	attributes.POSITION = []
	for position in arrays[Mesh.ARRAY_VERTEX]:
		attributes.POSITION.append(plain(node.global_transform.xform(position)))
	var order = arrays[Mesh.ARRAY_INDEX]
	return {"mode": MODES[node.mesh.surface_get_primitive_type(index)], "index": plain(order) if order else null, "count": len(arrays[Mesh.ARRAY_VERTEX]), "attributes": attributes}


# Where the bones of its skeleton put the vertices of a mesh.
func skinned(node):
	var out = []
	var skeleton = node.get_node_or_null(node.skeleton) if node.skin else null
	if not skeleton is Skeleton:
		return out
	for index in node.mesh.get_surface_count():
		var arrays = node.mesh.surface_get_arrays(index)
		if arrays[Mesh.ARRAY_BONES] == null:
			continue
		for i in len(arrays[Mesh.ARRAY_VERTEX]):
			var sum = Vector3()
			for k in range(4 * i, 4 * i + 4):
				var bind = arrays[Mesh.ARRAY_BONES][k]
				var bone = node.skin.get_bind_bone(bind)
				if bone < 0:
					bone = skeleton.find_bone(node.skin.get_bind_name(bind))
				var pose = skeleton.get_bone_global_pose(bone) * node.skin.get_bind_pose(bind)
				sum += arrays[Mesh.ARRAY_WEIGHTS][k] * pose.xform(arrays[Mesh.ARRAY_VERTEX][i])
			out.append([stepify(sum.x, 0.01), stepify(sum.y, 0.01), stepify(sum.z, 0.01)])
	return out


func answer(scene):
	print("\nLOADED")
	seen = {}
	lines = []
	var found = {"names": [], "nodes": [], "parts": [], "skin": [], "morphs": [], "tracks": [], "animations": [], "moved": [], "images": [], "pixels": [], "lights": 0}
	get_editor_interface().get_base_control().add_child(scene)  # places are those of a tree
	visit(scene, found)
	scene.free()
	return {"dump": JSON.print(lines), "facts": found}
