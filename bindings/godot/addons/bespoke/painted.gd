@tool
extends VBoxContainer
## What is painted on the garment: colours and custom channels that say where it fits, what is held, and what stays rigid.

const Folding := preload("folding.gd")
const NONE := "–"
## What each says, in the words of the other programs.
const TEXTS := {
	"fit": "How strongly the garment is drawn to the body, where it is painted: 0 is not at all. Without: 1 everywhere.",
	"pin": "What is painted keeps its place on the nearest bone.",
	"rigid": "Buttons, buckles or plates: each connected piece that is painted keeps its shape.",
}

var folding := Folding.new("Painted on the garment")
## OptionButtons by what they say.
var choices := {}


func _init() -> void:
	add_child(folding)
	for what: String in TEXTS:
		var row := HBoxContainer.new()
		var label := Label.new()
		label.text = what.capitalize()
		label.custom_minimum_size.x = 115 * EditorInterface.get_editor_scale()
		label.tooltip_text = TEXTS[what]
		label.mouse_filter = MOUSE_FILTER_STOP
		row.add_child(label)
		var choice := OptionButton.new()
		choice.size_flags_horizontal = SIZE_EXPAND_FILL
		choice.tooltip_text = TEXTS[what]
		choice.clip_text = true
		row.add_child(choice)
		choices[what] = choice
		folding.content.add_child(row)
	show_channels(null)


## Offers what this mesh has; what was chosen stays where it is there.
func show_channels(mesh: Mesh) -> void:
	var found := channels(mesh)
	visible = not found.is_empty()
	for what: String in choices:
		var choice: OptionButton = choices[what]
		var kept := chosen(what)
		choice.clear()
		choice.add_item(NONE)
		for channel in found:
			choice.add_item(channel)
			if channel == kept:
				choice.select(choice.item_count - 1)


## The channel that is chosen; empty for none.
func chosen(what: String) -> String:
	var choice: OptionButton = choices[what]
	return choice.get_item_text(choice.selected) if choice.selected > 0 else ""


func apply(retarget: BespokeRetarget) -> void:
	if chosen("fit"):
		retarget.set_fit_weights(chosen("fit"))
	if chosen("pin"):
		retarget.set_pins(chosen("pin"))
	if chosen("rigid"):
		retarget.add_rigid_group(chosen("rigid"))


## Channels of a mesh that can be read, by the names that the class takes.
static func channels(mesh: Mesh) -> PackedStringArray:
	var found := PackedStringArray()
	if not mesh is ArrayMesh:
		return found
	var format := 0
	for surface in mesh.get_surface_count():
		format |= (mesh as ArrayMesh).surface_get_format(surface)
	if format & Mesh.ARRAY_FORMAT_COLOR:
		for part in "rgba":
			found.append("color." + part)
	for custom in 4:
		if not format & (Mesh.ARRAY_FORMAT_CUSTOM0 << custom):
			continue
		var kind := format >> (Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT + 3 * custom) & Mesh.ARRAY_FORMAT_CUSTOM_MASK
		var width := 4
		if kind in [Mesh.ARRAY_CUSTOM_RG_HALF, Mesh.ARRAY_CUSTOM_RGBA_HALF]:
			continue
		if kind >= Mesh.ARRAY_CUSTOM_R_FLOAT:
			width = kind - Mesh.ARRAY_CUSTOM_R_FLOAT + 1
		for part in "xyzw".substr(0, width):
			found.append("custom%d.%s" % [custom, part])
	return found
