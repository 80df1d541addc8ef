extends Node3D
## A ball swings into a curtain. Drag a cloth with the left mouse button: the sheet on the right
## tears. R brings both back.
##
## With `-- --shot FILE.png` a script drags the sheet, and the picture of tick 150 is saved.

const SHOT_TICK := 150

@onready var camera: Camera3D = $Camera
@onready var ball: AnimatableBody3D = $Ball
@onready var cloths: Array[MuslinCloth3D] = [$Curtain, $Sheet]

## The cloth under the pointer, its grab, and the distance of the grabbed point from the camera.
var held: MuslinCloth3D
var grab := 0
var distance := 0.0
var ticks := 0
var shot := ""


func _ready() -> void:
	var words := OS.get_cmdline_user_args()
	var at := words.find("--shot")
	if at >= 0 and at + 1 < words.size():
		shot = words[at + 1]


func _physics_process(_delta: float) -> void:
	ticks += 1
	var seconds := ticks / float(Engine.physics_ticks_per_second)
	ball.position.z = 0.6 - 0.5 * (1.0 - cos(1.25 * seconds))
	if shot != "":
		play_script()


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseButton and event.button_index == MOUSE_BUTTON_LEFT:
		if event.pressed:
			press(event.position)
		else:
			release()
	elif event is InputEventMouseMotion:
		drag(event.position)
	elif event is InputEventKey and event.pressed and event.keycode == KEY_R:
		release()
		for cloth in cloths:
			cloth.reset()


## Grabs the cloth that the pointer hits first.
func press(at: Vector2) -> void:
	release()
	var origin := camera.project_ray_origin(at)
	var direction := camera.project_ray_normal(at)
	var nearest := INF
	for cloth in cloths:
		var hit := cloth.raycast(origin, direction)
		if not hit.is_empty() and hit.distance < nearest:
			nearest = hit.distance
			held = cloth
	if held == null:
		return
	var grabbed := held.grab_ray(origin, direction)
	grab = grabbed.grab
	distance = origin.distance_to(grabbed.position)


## Moves the grabbed particle with the pointer, at a constant distance from the camera.
func drag(at: Vector2) -> void:
	if held != null:
		var target := camera.project_ray_origin(at) + camera.project_ray_normal(at) * distance
		held.move_grab(grab, target)


func release() -> void:
	if held != null:
		held.release_grab(grab)
	held = null


## Drags the sheet until it tears, and saves the picture.
func play_script() -> void:
	var start := camera.unproject_position($Sheet.global_position + Vector3(-0.5, -0.3, 0.0))
	if ticks == 30:
		press(start)
	elif ticks > 30:
		drag(start + Vector2(2.5, 2.0) * (ticks - 30))
	if ticks == SHOT_TICK:
		await RenderingServer.frame_post_draw
		var error := get_viewport().get_texture().get_image().save_png(shot)
		get_tree().quit(0 if error == OK else 1)
