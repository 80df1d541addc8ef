extends SceneTree
## Tests of MuslinCloth3D, run by `cargo xtask test godot`:
## `godot --headless --fixed-fps 60 --path PROJECT --script test_cloth.gd`
##
## Each function whose name starts with `test_` is a test. Those of `drawn_` need a display.

var checks := 0
var failures := 0
var scene: Node3D


func _initialize() -> void:
	await process_frame
	var prefix := "test_" if DisplayServer.get_name() == "headless" else "drawn_"
	for method in get_script().get_script_method_list():
		var name: String = method.name
		if name.begins_with(prefix):
			scene = Node3D.new()
			root.add_child(scene)
			var before := failures
			await call(name)
			print("%s %s" % ["ok  " if failures == before else "FAIL", name])
			scene.free()
	print("%d checks passed, %d failed" % [checks - failures, failures])
	quit(0 if failures == 0 and checks > 0 else 1)


func check(ok: bool, what: String) -> void:
	checks += 1
	if not ok:
		failures += 1
		printerr("FAILED: " + what)


func near(a: float, b: float, tolerance: float, what: String) -> void:
	check(absf(a - b) <= tolerance, "%s: %f, not %f" % [what, a, b])


## A cloth that no group of colliders concerns, ready in the scene.
func add_cloth(properties: Dictionary) -> MuslinCloth3D:
	var cloth := MuslinCloth3D.new()
	cloth.collider_group = &""
	for property in properties:
		cloth.set(property, properties[property])
	scene.add_child(cloth)
	return cloth


## Waits for physics ticks, of which each frame has one.
func ticks(count: int) -> void:
	for i in count:
		await process_frame


func lowest(cloth: MuslinCloth3D) -> float:
	var low := INF
	for position in cloth.get_positions():
		low = minf(low, position.y)
	return low


## A square of two by two cells in the xz plane, clockwise seen from above, red along x = -1.
func square(with_colors: bool) -> ArrayMesh:
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	var points := PackedVector3Array()
	var colors := PackedColorArray()
	for z in 3:
		for x in 3:
			points.append(Vector3(x - 1, 0, z - 1))
			colors.append(Color.RED if x == 0 else Color.BLUE)
	arrays[Mesh.ARRAY_VERTEX] = points
	if with_colors:
		arrays[Mesh.ARRAY_COLOR] = colors
	var indices := PackedInt32Array()
	for z in 2:
		for x in 2:
			var a := z * 3 + x
			indices.append_array([a, a + 1, a + 4, a, a + 4, a + 3])
	arrays[Mesh.ARRAY_INDEX] = indices
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh


func test_a_curtain_hangs_from_its_top_edge() -> void:
	var cloth := add_cloth({
		columns = 11, rows = 21, width = 1.0, height = 2.0, position = Vector3(3, 5, 1),
	})
	check(cloth.get_last_error() == "", "no error: " + cloth.get_last_error())
	var before := cloth.get_positions()
	check(before.size() == 231, "one vertex per particle")
	check(before[0].is_equal_approx(Vector3(2.5, 5, 1)), "the grid hangs from the node")
	check(before[230].is_equal_approx(Vector3(3.5, 3, 1)), "down to its height")
	check(cloth.get_pinned() == PackedInt32Array(range(11)), "the first row is pinned")
	await ticks(120)
	var after := cloth.get_positions()
	check(after[0] == before[0] and after[10] == before[10], "pins hold exactly")
	near(after[230].y, 3.0, 0.02, "a hanging sheet keeps its length")
	check(cloth.get_stats().ticks == 120, "one tick per physics frame")
	check(cloth.get_stats().max_stretch < 0.02, "hardly any stretch")


func test_a_sheet_without_pins_falls_half_g_t_squared() -> void:
	var cloth := add_cloth({
		pin_mode = MuslinCloth3D.PIN_NONE, columns = 5, rows = 5, damping = 0.0,
		wind_air_density = 0.0,
	})
	var start := cloth.get_positions()[0].y
	await ticks(60)
	near(start - cloth.get_positions()[0].y, 0.5 * 9.81, 0.1, "the fall of a second")


func test_pins_come_from_colours_lists_and_edges() -> void:
	var colored := add_cloth({mesh = square(true), pin_mode = MuslinCloth3D.PIN_VERTEX_COLOR})
	check(colored.get_pinned() == PackedInt32Array([0, 3, 6]), "red vertices are pinned")
	var listed := add_cloth({
		mesh = square(false), pin_mode = MuslinCloth3D.PIN_VERTICES,
		pin_vertices = PackedInt32Array([4, 8]),
	})
	check(listed.get_pinned() == PackedInt32Array([4, 8]), "listed vertices are pinned")
	var flag := add_cloth({columns = 4, rows = 3, pin_mode = MuslinCloth3D.PIN_LEFT_EDGE})
	check(flag.get_pinned() == PackedInt32Array([0, 4, 8]), "the first column is pinned")
	var corners := add_cloth({columns = 4, rows = 3, pin_mode = MuslinCloth3D.PIN_CORNERS})
	check(corners.get_pinned() == PackedInt32Array([0, 3, 8, 11]), "the corners are pinned")


func test_the_front_of_a_mesh_stays_its_front() -> void:
	var cloth := add_cloth({mesh = square(true), pin_mode = MuslinCloth3D.PIN_VERTEX_COLOR})
	var hit := cloth.raycast(Vector3(0.4, 1, 0.3), Vector3.DOWN)
	check(not hit.is_empty() and hit.normal.is_equal_approx(Vector3.UP), "hit from above")
	near(hit.get("distance", 0.0), 1.0, 1e-4, "the distance of the hit")
	check(cloth.raycast(Vector3(4, 1, 0), Vector3.DOWN).is_empty(), "a ray beside it hits nothing")
	var arrays := cloth.get_drawn_mesh().surface_get_arrays(0)
	var i: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
	var p: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var up := (p[i[2]] - p[i[0]]).cross(p[i[1]] - p[i[0]])
	check(up.y > 0.0, "drawn triangles are clockwise seen from the front")
	check(arrays[Mesh.ARRAY_NORMAL][4].y > 0.9999, "drawn normals look to the front")


func test_a_mesh_instance_gives_its_mesh_place_and_material() -> void:
	var source := MeshInstance3D.new()
	source.mesh = square(true)
	source.position = Vector3(0, 2, 0)
	source.scale = Vector3(0.5, 0.5, 0.5)
	var material := StandardMaterial3D.new()
	source.set_surface_override_material(0, material)
	scene.add_child(source)
	var cloth := add_cloth({mesh_source = source, pin_mode = MuslinCloth3D.PIN_VERTEX_COLOR})
	check(cloth.get_positions()[8].is_equal_approx(Vector3(0.5, 2, 0.5)), "at its place and scale")
	check(not source.visible, "the source is hidden")
	check(cloth.get_drawn_mesh().surface_get_material(0) == material, "its material draws the cloth")


func test_seams_of_a_mesh_are_joined() -> void:
	var mesh := BoxMesh.new()
	mesh.subdivide_width = 3
	mesh.subdivide_height = 3
	mesh.subdivide_depth = 3
	var ball := add_cloth({mesh = mesh, pin_mode = MuslinCloth3D.PIN_NONE})
	check(ball.get_stats().pieces == 1, "six sides are one piece")
	var loose := add_cloth({mesh = mesh, pin_mode = MuslinCloth3D.PIN_NONE, weld_distance = -1.0})
	check(loose.get_stats().pieces == 6, "without welding there are six")


## A shape 1 m below a small free sheet, and the height of its top.
func collision_shapes() -> Array:
	var sphere := SphereShape3D.new()
	sphere.radius = 0.5
	var capsule := CapsuleShape3D.new()
	capsule.radius = 0.5
	capsule.height = 2.0
	var box := BoxShape3D.new()
	box.size = Vector3(2, 0.5, 2)
	var cylinder := CylinderShape3D.new()
	cylinder.radius = 1.0
	cylinder.height = 0.5
	var plane := WorldBoundaryShape3D.new()
	plane.plane = Plane(Vector3.UP, 0.1)
	var convex := ConvexPolygonShape3D.new()
	convex.points = PackedVector3Array([
		Vector3(-1, 0, -1), Vector3(1, 0, -1), Vector3(1, 0, 1), Vector3(-1, 0, 1), Vector3.DOWN,
	])
	var concave := ConcavePolygonShape3D.new()
	concave.set_faces(PackedVector3Array([
		Vector3(-1, 0.2, -1), Vector3(1, 0.2, -1), Vector3(1, 0.2, 1),
		Vector3(-1, 0.2, -1), Vector3(1, 0.2, 1), Vector3(-1, 0.2, 1),
	]))
	var map := HeightMapShape3D.new()
	map.map_width = 4
	map.map_depth = 3
	var heights := PackedFloat32Array()
	heights.resize(12)
	heights.fill(0.3)
	map.map_data = heights
	return [
		[sphere, 0.5], [capsule, 1.0], [box, 0.25], [cylinder, 0.25], [plane, 0.1], [convex, 0.0],
		[concave, 0.2], [map, 0.3],
	]


func test_cloth_lies_on_every_shape() -> void:
	for pair in collision_shapes():
		var shape: Shape3D = pair[0]
		var holder := Node3D.new()
		holder.position = Vector3(0, -1, 0)
		var node := CollisionShape3D.new()
		node.shape = shape
		holder.add_child(node)
		scene.add_child(holder)
		var cloth := add_cloth({
			columns = 7, rows = 7, width = 0.3, height = 0.3, pin_mode = MuslinCloth3D.PIN_NONE,
			rotation = Vector3(-PI / 2, 0, 0), position = Vector3(0, pair[1] - 0.9, -0.15),
			damping = 3.0, friction = 2.0,
		})
		var paths: Array[NodePath] = [cloth.get_path_to(holder)]
		cloth.collider_nodes = paths
		await ticks(50)
		check(cloth.get_last_error() == "", shape.get_class() + ": " + cloth.get_last_error())
		check(cloth.get_stats().colliders == 1, shape.get_class() + " is a collider")
		near(cloth.get_positions()[24].y, pair[1] - 1.0, 0.04, "on a " + shape.get_class())
		check(cloth.get_stats().free_inside == 0, "nothing is inside a " + shape.get_class())
		cloth.free()
		holder.free()


func test_shapes_take_the_scale_of_their_nodes() -> void:
	var sphere := SphereShape3D.new()
	var box := BoxShape3D.new()
	for pair in [[sphere, Vector3.ONE * 2.0, 1.0], [box, Vector3(3, 2, 3), 1.0]]:
		var node := CollisionShape3D.new()
		node.shape = pair[0]
		node.scale = pair[1]
		var cloth := add_cloth({
			columns = 5, rows = 5, width = 0.2, height = 0.2, pin_mode = MuslinCloth3D.PIN_NONE,
			rotation = Vector3(-PI / 2, 0, 0), position = Vector3(0, 1.1, -0.1), damping = 3.0,
		})
		cloth.add_child(node)
		node.top_level = true
		node.transform = Transform3D(Basis.from_scale(pair[1]), Vector3.ZERO)
		await ticks(40)
		check(cloth.get_last_error() == "", "scaled: " + cloth.get_last_error())
		near(cloth.get_positions()[12].y, pair[2], 0.05, "on a scaled " + pair[0].get_class())
		cloth.free()


func test_a_moving_body_of_the_group_pushes_the_cloth() -> void:
	var body := AnimatableBody3D.new()
	body.sync_to_physics = false
	body.add_to_group("walls")
	body.position = Vector3(0, -0.8, -1.0)
	var node := CollisionShape3D.new()
	var box := BoxShape3D.new()
	box.size = Vector3(2, 0.8, 1)
	node.shape = box
	body.add_child(node)
	scene.add_child(body)
	var cloth := add_cloth({columns = 15, rows = 15, width = 1.0, height = 1.0})
	cloth.collider_group = &"walls"
	await ticks(2)
	check(cloth.get_stats().colliders == 1, "the body of the group is a collider")
	for i in 60:
		body.position.z += 0.015
		await process_frame
	var middle := cloth.get_positions()[10 * 15 + 7]
	check(middle.z > 0.38, "the box pushed the cloth to z = %f" % middle.z)
	check(cloth.get_stats().free_inside == 0, "nothing is inside the box")
	node.disabled = true
	await ticks(2)
	check(cloth.get_stats().colliders == 0, "a disabled shape is no collider")
	node.disabled = false
	box.size = Vector3(0.5, 0.5, 0.5)
	await ticks(2)
	check(cloth.get_stats().colliders == 1, "an enabled one is, also after its shape changed")
	body.free()
	await ticks(2)
	check(cloth.get_stats().colliders == 0, "a freed body is no collider")


func test_a_pulled_sheet_tears_and_tells_so() -> void:
	var cloth := add_cloth({
		columns = 20, rows = 20, width = 1.0, height = 1.0, tearing = true, tear_stretch = 1.2,
		pin_mode = MuslinCloth3D.PIN_CORNERS,
	})
	var torn := []
	cloth.torn.connect(func(position: Vector3, a: int, b: int) -> void:
		torn.append([position, a, b])
		var marker := Node3D.new()
		marker.position = position
		scene.add_child(marker)
		check(cloth.get_stats().particles > 0, "handlers may call the cloth and change the scene"))
	var grabbed := cloth.grab_ray(Vector3(0.1, -0.4, 2), Vector3.FORWARD, 0.1)
	check(grabbed.get("grab", 0) != 0, "the ray grabs")
	check(grabbed.position.distance_to(Vector3(0.1, -0.4, 0)) < 0.06, "near the hit")
	for i in 60:
		check(cloth.move_grab(grabbed.grab, grabbed.position + Vector3(0, 0, 0.04 * i)), "moves")
		await process_frame
	check(torn.size() > 0, "the signal `torn` came")
	check(cloth.get_positions().size() > 400, "tears split vertices")
	check(cloth.release_grab(grabbed.grab), "the grab is released")
	check(not cloth.release_grab(grabbed.grab), "but not twice")
	check("`grab`" in cloth.get_last_error(), cloth.get_last_error())
	check(cloth.grab_ray(Vector3(9, 9, 9), Vector3.UP, 0.1).is_empty(), "a ray beside grabs nothing")
	cloth.reset()
	check(cloth.get_positions().size() == 400, "a reset cloth is whole")
	check(cloth.get_stats().ticks == 0, "and has run no tick")


func test_a_cut_through_the_middle_gives_two_pieces() -> void:
	var cloth := add_cloth({columns = 11, rows = 11, width = 1.0, height = 1.0, tearing = true})
	var detached := []
	cloth.piece_detached.connect(func(_at: Vector3, triangles: int) -> void:
		detached.append(triangles))
	var edges := cloth.cut(Vector3(-1, -0.45, -1), Vector3(1, -0.45, -1), Vector3(0, 0, 2))
	check(edges > 10, "the blade cut %d edges" % edges)
	check(cloth.get_stats().pieces == 2, "two pieces")
	await ticks(2)
	check(detached.size() == 1, "the signal `piece_detached` came")
	check(cloth.cut(Vector3(NAN, 0, 0), Vector3.ZERO, Vector3.UP) == -1, "a bad blade is refused")


func test_a_restored_cloth_continues_with_the_same_bits() -> void:
	var shape := SphereShape3D.new()
	shape.radius = 0.3
	var node := CollisionShape3D.new()
	node.shape = shape
	node.position = Vector3(0, -0.5, 0.2)
	var cloth := add_cloth({columns = 12, rows = 12, width = 1.0, height = 1.0, wind_velocity = Vector3(0, 0, 3)})
	cloth.add_child(node)
	await ticks(40)
	var bytes := cloth.save()
	check(bytes.size() > 1000, "a state has bytes")
	await ticks(20)
	check(cloth.restore(bytes), "the state is restored: " + cloth.get_last_error())
	check(cloth.get_stats().ticks == 40, "to its tick")
	await ticks(20)
	var first := cloth.state_hash()
	check(cloth.restore(bytes), "once more")
	await ticks(20)
	check(cloth.state_hash() == first, "the same state continues with the same bits")
	check(cloth.get_stats().colliders == 1, "the colliders of the scene act on it")
	var damaged := bytes.duplicate()
	damaged[200] ^= 1
	for wrong in [damaged, PackedByteArray(), PackedByteArray([1, 2, 3]), bytes.slice(0, 100)]:
		check(not cloth.restore(wrong), "bytes that are no state are refused")
		check(cloth.get_last_error().begins_with("`bytes` must"), cloth.get_last_error())
	check(cloth.state_hash() == first, "and change nothing")


func test_pins_follow_the_node_and_teleport_moves_all() -> void:
	var cloth := add_cloth({columns = 8, rows = 8, width = 0.7, height = 0.7})
	await ticks(5)
	cloth.position = Vector3(0.2, 0.1, 0)
	cloth.rotation.y = 0.3
	await ticks(2)
	var corner := cloth.get_positions()[0]
	check(corner.distance_to(cloth.to_global(Vector3(-0.35, 0, 0))) < 1e-4, "pins follow the node")
	await ticks(200)
	cloth.position = Vector3(50, 3, 0)
	var speed: float = cloth.get_stats().max_speed
	cloth.teleport()
	check(cloth.get_positions()[63].x > 49.0, "teleport moves all at once")
	await ticks(1)
	near(cloth.get_stats().max_speed, speed, 0.05, "without a speed")
	cloth.reset()
	check(cloth.get_positions()[0].distance_to(cloth.to_global(Vector3(-0.35, 0, 0))) < 1e-4,
		"a reset brings it to the node")


func test_material_values_are_those_of_the_preset_unless_given() -> void:
	var cloth := add_cloth({preset = MuslinCloth3D.PRESET_DENIM, bend_stiffness = 0.002})
	near(cloth.get_material_values().density, 0.38, 1e-6, "denim")
	near(cloth.get_material_values().bend_stiffness, 0.002, 1e-8, "given")
	cloth.preset = MuslinCloth3D.PRESET_SILK
	cloth.friction = 0.9
	await ticks(2)
	near(cloth.get_material_values().density, 0.1, 1e-6, "a live change to silk")
	near(cloth.get_material_values().friction, 0.9, 1e-6, "a live change of friction")


func test_wind_moves_cloth_downwind() -> void:
	var cloth := add_cloth({columns = 12, rows = 12, width = 1.0, height = 1.0, wind_velocity = Vector3(0, 0, 6)})
	await ticks(60)
	check(cloth.get_positions()[143].z > 0.2, "the wind blows it to z = %f" % cloth.get_positions()[143].z)


func test_refusals_name_property_and_rule_and_make_no_cloth() -> void:
	var two := ArrayMesh.new()
	for i in 2:
		two.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, square(false).surface_get_arrays(0))
	var lines := ArrayMesh.new()
	lines.add_surface_from_arrays(Mesh.PRIMITIVE_LINE_STRIP, square(false).surface_get_arrays(0))
	for row in [
		[{columns = 1}, "`columns` must be at least 2"],
		[{rows = -4}, "`rows` must be at least 2"],
		[{columns = 5000, rows = 5000}, "`columns` must give at most 4194304 particles"],
		[{width = 0.0}, "`width` must be above 0 and finite"],
		[{height = NAN}, "`height` must be above 0 and finite"],
		[{weld_distance = INF}, "`weld_distance` must be finite"],
		[{simplify_below = -1.0}, "`simplify_below` must be finite and at least 0"],
		[{extra_particles = -2}, "`extra_particles` must be at least -1"],
		[{mesh = two}, "`mesh` must have exactly one surface, but has 2"],
		[{mesh = lines}, "`mesh` must be made of triangles"],
		[{mesh = square(false)}, "`pin_mode` must be None, VertexColor or Vertices"],
		[{mesh = square(false), pin_mode = 5}, "`mesh` must have vertex colours"],
		[{pin_mode = 5}, "`pin_mode` must not be VertexColor without a `mesh`"],
		[{pin_mode = 6, pin_vertices = PackedInt32Array([-1])}, "`pin_vertices` must be at least 0"],
		[{pin_mode = 6, pin_vertices = PackedInt32Array([1600])}, "`pin_vertices` must be below 1600"],
		[{scale = Vector3(1, 1e-30, 1)}, "`transform` must be finite, with a scale that is not 0"],
		[{density = 0.0}, "`density` must be above 0 and finite"],
		[{thickness = -2.0}, "`thickness` must be at least 0 and finite"],
		[{tear_stretch = 0.5}, "`tear_stretch` must be 0 (never) or above 1 and finite"],
		[{substeps = 0}, "`substeps` must be from 1 to 1000"],
		[{iterations = -3}, "`iterations` must be from 1 to 1000"],
		[{gravity = Vector3(0, NAN, 0)}, "`gravity` must be finite"],
		[{max_stretch = -1.0}, "`max_stretch` must be at least 0 and finite"],
		[{wind_gust = 2.0}, "`wind_gust` must be from 0 to 1"],
		[{wind_velocity = Vector3(INF, 0, 0)}, "`wind_velocity` must be finite"],
	]:
		var cloth := add_cloth(row[0])
		check(cloth.get_last_error().begins_with(row[1]), "%s, not %s" % [cloth.get_last_error(), row[1]])
		check(cloth.get_positions().is_empty() and cloth.get_stats().is_empty(), "no cloth is made")
		check(cloth.get_drawn_mesh() == null, "and none is drawn")
		check(cloth.grab_ray(Vector3.ZERO, Vector3.UP).is_empty(), "calls are refused")
		await ticks(1)
		cloth.free()


func test_a_refused_live_change_keeps_the_values_of_the_cloth() -> void:
	var cloth := add_cloth({columns = 6, rows = 6, friction = 0.7})
	await ticks(2)
	cloth.friction = 0.1
	cloth.substeps = 8
	cloth.wind_gust = -1.0
	await ticks(2)
	check(cloth.get_last_error() == "`wind_gust` must be from 0 to 1", cloth.get_last_error())
	near(cloth.get_material_values().friction, 0.7, 1e-6, "nothing of the change acts")
	check(cloth.get_stats().ticks == 4, "the cloth runs on")
	cloth.wind_gust = 0.5
	await ticks(1)
	near(cloth.get_material_values().friction, 0.1, 1e-6, "after the correction all of it acts")
	cloth.inertia = 2.0
	await ticks(1)
	check(cloth.get_last_error() == "`inertia` must be from 0 to 1", cloth.get_last_error())
	cloth.inertia = 1.0
	cloth.set("pin_mode", 77)
	check(cloth.pin_mode == MuslinCloth3D.PIN_TOP_EDGE, "a number without a meaning is refused")
	cloth.columns = 1
	check(not cloth.rebuild(), "a bad shape is refused")
	check(cloth.get_positions().size() == 36, "and the cloth stays")


func test_refused_colliders_are_named_and_the_others_act() -> void:
	var cloth := add_cloth({columns = 6, rows = 6})
	var good := CollisionShape3D.new()
	good.shape = SphereShape3D.new()
	good.position.z = 5.0
	cloth.add_child(good)
	for row in [
		[SphereShape3D.new(), Vector3(1, 2, 1), "`transform` must be scaled equally along all axes for a sphere"],
		[HeightMapShape3D.new(), Vector3(1, 1, 2), "`transform` must be scaled equally along x and z"],
		[HeightMapShape3D.new(), Vector3(1, -1, 1), "for a height map, and not mirrored"],
		[SeparationRayShape3D.new(), Vector3.ONE, "`shape` must not be a SeparationRayShape3D"],
		[ConvexPolygonShape3D.new(), Vector3.ONE, "`shape.positions` must be from 4 to 1024"],
		[ConcavePolygonShape3D.new(), Vector3.ONE, "`shape.indices` must hold triangles"],
	]:
		var node := CollisionShape3D.new()
		node.name = "Refused"
		node.shape = row[0]
		node.scale = row[1]
		cloth.add_child(node)
		await ticks(2)
		var error := cloth.get_last_error()
		check(row[2] in error and "Refused" in error, "%s, not %s" % [error, row[2]])
		check(cloth.get_stats().colliders == 1, "the good one acts")
		node.free()
		await ticks(1)
	var paths: Array[NodePath] = [^"Nobody"]
	cloth.collider_nodes = paths
	await ticks(2)
	check("`collider_nodes[0]` must name a node" in cloth.get_last_error(), cloth.get_last_error())
	paths.clear()
	cloth.collider_nodes = paths
	cloth.collider_friction = -3.0
	await ticks(2)
	check("`collider_friction` must be at least 0" in cloth.get_last_error(), cloth.get_last_error())


func test_refused_calls_say_why() -> void:
	var cloth := add_cloth({columns = 6, rows = 6})
	var hash := cloth.state_hash()
	check(cloth.grab_ray(Vector3.ZERO, Vector3.ZERO).is_empty(), "a ray without a direction")
	check("`direction` must" in cloth.get_last_error(), cloth.get_last_error())
	check(not cloth.move_grab(77, Vector3.ZERO), "an unknown grab")
	check("`grab` must" in cloth.get_last_error(), cloth.get_last_error())
	check(not cloth.pin(-1, Vector3.ZERO), "a negative particle")
	check("`particle` must" in cloth.get_last_error(), cloth.get_last_error())
	check(not cloth.unpin(36), "a particle too high")
	check("`particle` must be below 36" in cloth.get_last_error(), cloth.get_last_error())
	cloth.step(-1)
	check("`ticks` must" in cloth.get_last_error(), cloth.get_last_error())
	check(cloth.state_hash() == hash, "refused calls change nothing")
	check(cloth.pin(35, Vector3(1, -2, 0)) and cloth.unpin(0), "good ones act")
	cloth.step(3)
	check(cloth.get_positions()[35].is_equal_approx(Vector3(1, -2, 0)), "the pin is at its target")


func test_a_script_on_the_node_may_have_callbacks_of_its_own() -> void:
	var script := GDScript.new()
	script.source_code = """extends MuslinCloth3D
var calls := 0
func _ready(): calls += 1
func _process(_delta): calls += 1
func _physics_process(_delta): calls += 1
"""
	script.reload()
	var cloth: MuslinCloth3D = script.new()
	scene.add_child(cloth)
	await ticks(3)
	check(cloth.get_stats().ticks >= 2, "the cloth moves")
	check(cloth.calls > 4, "and the script runs")


func test_equal_scenes_have_equal_bits() -> void:
	var cloth := add_cloth({columns = 9, rows = 9, width = 0.8, height = 0.8})
	var other := add_cloth({columns = 9, rows = 9, width = 0.8, height = 0.8})
	await ticks(30)
	check(cloth.state_hash() == other.state_hash() and cloth.state_hash() != 0, "equal bits")


func test_properties_show_their_units() -> void:
	var properties := {}
	for property in ClassDB.class_get_property_list("MuslinCloth3D", true):
		properties[property.name] = property
	for row in [["width", "suffix:m"], ["density", "suffix:kg/m²"], ["gravity", "suffix:m/s²"], ["wind_velocity", "suffix:m/s"]]:
		check(row[1] in properties[row[0]].hint_string, "%s has its unit" % row[0])


## `cargo xtask test godot` writes the blocks of the manual beside this script.
func test_the_scripts_of_the_manual_run() -> void:
	var names := DirAccess.get_files_at("res://manual")
	var scripts := Array(names).filter(func(file: String) -> bool: return file.ends_with(".gd"))
	check(scripts.size() > 0, "the manual has scripts")
	for file in scripts:
		var script: GDScript = load("res://manual/" + file)
		check(script != null and script.can_instantiate(), file + " is a script")
		var node: Node = script.new()
		scene.add_child(node)
		await ticks(30)
		var cloths := node.find_children("*", "MuslinCloth3D", true, false)
		check(cloths.size() > 0, file + " makes a cloth")
		for cloth in cloths:
			check(cloth.get_stats().get("ticks", 0) > 20, file + " has a cloth that moves")
			check(cloth.get_last_error() == "", file + ": " + cloth.get_last_error())
		node.free()


## The mesh in the renderer is the cloth: positions, normals and triangles, also after ticks and
## tears, where only changed buffers are sent.
func drawn_mesh_is_the_cloth() -> void:
	var camera := Camera3D.new()
	camera.position = Vector3(0, -0.5, 3)
	scene.add_child(camera)
	var cloth := add_cloth({
		columns = 15, rows = 15, width = 1.0, height = 1.0, tearing = true, tear_stretch = 1.2,
		position = Vector3(0.1, 0.2, -0.3), rotation = Vector3(0.2, 0.4, 0), scale = Vector3(1.5, 1.5, 1.5),
		wind_velocity = Vector3(0, 0, 4), tangents = true,
	})
	for part in 3:
		await ticks(20)
		await RenderingServer.frame_post_draw
		if part == 1:
			var cut := cloth.cut(Vector3(0.1, 3, -4), Vector3(0.1, -3, -4), Vector3(0, 0, 8))
			check(cut > 5, "the blade cut %d edges" % cut)
			await process_frame
			await RenderingServer.frame_post_draw
		var arrays := cloth.get_drawn_mesh().surface_get_arrays(0)
		var points: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
		var normals: PackedVector3Array = arrays[Mesh.ARRAY_NORMAL]
		var indices: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
		var positions := cloth.get_positions()
		check(points.size() == positions.size(), "as many vertices")
		var worst := 0.0
		for i in points.size():
			worst = maxf(worst, cloth.to_global(points[i]).distance_to(positions[i]))
		check(worst < 1e-4, "drawn positions are those of the cloth, within %f" % worst)
		var sums := PackedVector3Array()
		sums.resize(points.size())
		for t in range(0, indices.size(), 3):
			var a := points[indices[t]]
			var across := (points[indices[t + 2]] - a).cross(points[indices[t + 1]] - a)
			for corner in 3:
				sums[indices[t + corner]] += across
		var least := 1.0
		for i in points.size():
			least = minf(least, sums[i].normalized().dot(normals[i]))
		check(least > 0.999, "drawn normals belong to the drawn triangles: %f" % least)
		var tool := SurfaceTool.new()
		tool.create_from(cloth.get_drawn_mesh(), 0)
		tool.generate_tangents()
		var expected: PackedFloat32Array = tool.commit_to_arrays()[Mesh.ARRAY_TANGENT]
		var tangents: PackedFloat32Array = arrays[Mesh.ARRAY_TANGENT]
		var farthest := 1.0
		for i in points.size():
			var drawn := Vector3(tangents[4 * i], tangents[4 * i + 1], tangents[4 * i + 2])
			var usual := Vector3(expected[4 * i], expected[4 * i + 1], expected[4 * i + 2])
			farthest = minf(farthest, drawn.dot(usual))
			check(tangents[4 * i + 3] == expected[4 * i + 3], "the handedness of vertex %d" % i)
		check(farthest > 0.95, "drawn tangents are like those of Godot: %f" % farthest)
		var box := cloth.get_aabb().grow(1e-4)
		check(box.has_point(points[0]) and box.has_point(points[-1]), "the box holds the cloth")


## With physics interpolation the cloth is drawn between its last two ticks. In a frame that runs one
## tick and no time more, that is at the tick before.
func drawn_cloth_is_interpolated_between_ticks() -> void:
	var camera := Camera3D.new()
	camera.position = Vector3(0, -0.5, 3)
	scene.add_child(camera)
	physics_interpolation = true
	var cloth := add_cloth({
		columns = 5, rows = 5, width = 1.0, height = 1.0, pin_mode = MuslinCloth3D.PIN_NONE,
	})
	await ticks(20)
	for i in 3:
		var last := cloth.get_positions()
		await process_frame
		await RenderingServer.frame_post_draw
		var now := cloth.get_positions()
		var arrays := cloth.get_drawn_mesh().surface_get_arrays(0)
		var drawn: float = arrays[Mesh.ARRAY_VERTEX][12].y
		var share := Engine.get_physics_interpolation_fraction()
		check(now[12].y < last[12].y - 0.01, "the cloth falls")
		near(drawn, lerpf(last[12].y, now[12].y, share), 1e-3, "drawn between ticks")
	physics_interpolation = false
	await ticks(2)
	await RenderingServer.frame_post_draw
	var arrays := cloth.get_drawn_mesh().surface_get_arrays(0)
	near(arrays[Mesh.ARRAY_VERTEX][12].y, cloth.get_positions()[12].y, 1e-3, "at the last tick")
