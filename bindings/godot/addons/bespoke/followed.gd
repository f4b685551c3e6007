@tool
extends VBoxContainer
## Blend shapes of the body that the garment is to follow, with blend shapes of its own.

const Folding := preload("folding.gd")
const ABOUT := (
	"The garment gets a blend shape of the same name, which goes with that of the body. Takes about as long as the fit, for each of "
	+ "them; those of a face need none.")

var folding := Folding.new("Follow blend shapes")
## CheckBoxes by the names of the shapes.
var boxes := {}


func _init() -> void:
	folding.title.tooltip_text = ABOUT
	add_child(folding)
	show_shapes([])


## Offers what these meshes have; what was chosen stays where it is there.
func show_shapes(bodies: Array[MeshInstance3D]) -> void:
	var kept := chosen()
	for box: CheckBox in boxes.values():
		box.queue_free()
	boxes = {}
	for body in bodies:
		if not body.mesh is ArrayMesh:
			continue
		for k in body.get_blend_shape_count():
			var shape := str((body.mesh as ArrayMesh).get_blend_shape_name(k))
			if boxes.has(shape):
				continue
			var box := CheckBox.new()
			box.text = shape
			box.tooltip_text = ABOUT
			box.clip_text = true
			box.button_pressed = kept.has(shape)
			boxes[shape] = box
			folding.content.add_child(box)
	visible = not boxes.is_empty()


## Their names.
func chosen() -> PackedStringArray:
	var names := PackedStringArray()
	for shape: String in boxes:
		if boxes[shape].button_pressed:
			names.append(shape)
	return names


func apply(retarget: BespokeRetarget) -> void:
	if not chosen().is_empty():
		retarget.set_answered_blend_shapes(chosen())
