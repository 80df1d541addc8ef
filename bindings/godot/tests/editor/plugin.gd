@tool
extends EditorPlugin
## Tests of MuslinCloth3D in the editor: it is drawn at rest, follows its properties, and shows what
## is wrong with them. `cargo xtask test godot` enables this plugin in a copy of the project.

var checks := 0
var failures := 0


func _enter_tree() -> void:
	run.call_deferred()


func check(ok: bool, what: String) -> void:
	checks += 1
	if not ok:
		failures += 1
		printerr("FAILED: " + what)


func frames(count: int) -> void:
	for i in count:
		await get_tree().process_frame


func run() -> void:
	await frames(5)
	var cloth := MuslinCloth3D.new()
	cloth.columns = 6
	cloth.rows = 5
	add_child(cloth)
	await frames(20)
	check(cloth.get_drawn_mesh().surface_get_array_len(0) == 30, "the grid is drawn")
	check(cloth.get_stats().ticks == 0, "and does not move")
	check(cloth.get_base() == cloth.get_drawn_mesh().get_rid(), "its mesh is that of the node")
	cloth.columns = 7
	await frames(3)
	check(cloth.get_drawn_mesh().surface_get_array_len(0) == 35, "it follows its properties")
	cloth.substeps = 0
	await frames(3)
	check(cloth.get_last_error() == "`substeps` must be from 1 to 1000", cloth.get_last_error())
	check(cloth.get_drawn_mesh().get_surface_count() == 0, "what is refused is not drawn")
	cloth.substeps = 4
	var mesh := PlaneMesh.new()
	cloth.mesh = mesh
	cloth.pin_mode = MuslinCloth3D.PIN_NONE
	await frames(3)
	check(cloth.get_last_error() == "", cloth.get_last_error())
	check(cloth.get_drawn_mesh().surface_get_array_len(0) == 4, "a mesh is drawn")
	mesh.subdivide_width = 3
	await frames(3)
	check(cloth.get_drawn_mesh().surface_get_array_len(0) == 10, "and its changes")
	check(cloth.mesh == mesh, "the property keeps the mesh at rest")
	print("ok   the cloth in the editor")
	print("%d checks passed, %d failed" % [checks - failures, failures])
	get_tree().quit(0 if failures == 0 and checks == 10 else 1)
