@tool
extends VBoxContainer
## The dials, and behind a button all other options for artists. What they say comes from the library.

const Folding := preload("folding.gd")
## The dials, and the options that they are.
const DIALS := {"fit": "fit_weight", "looseness": "designed_clearance", "offset": "offset"}
## The library's memory and threads are no matter of a garment.
const LEFT_OUT := ["threads", "memory_limit"]

## Controls by the names of the options.
var controls := {}
var more := Folding.new("More options")


func _init() -> void:
	var table := {}
	for option in BespokeRetarget.get_options():
		table[option.name] = option
	for dial: String in DIALS:
		_add(self, dial, table[DIALS[dial]])
	add_child(more)
	for name: String in table:
		if not table[name].is_expert and not name in DIALS.values() and not name in LEFT_OUT:
			_add(more.content, name, table[name])


## Hands everything over that is not as by default.
func apply(retarget: BespokeRetarget) -> void:
	for name: String in controls:
		var control: Control = controls[name]
		var value: Variant = control.button_pressed if control is CheckBox else control.value
		if value != control.get_meta(&"default"):
			retarget.set_option(name, value)


func _add(column: Control, title: String, option: Dictionary) -> void:
	var row := HBoxContainer.new()
	var label := Label.new()
	label.text = title.capitalize()
	label.custom_minimum_size.x = 115 * EditorInterface.get_editor_scale()
	row.add_child(label)
	var control: Control
	if option.default is bool:
		var box := CheckBox.new()
		box.button_pressed = option.default
		control = box
	else:
		var box := SpinBox.new()
		box.step = 0.001 if option.default <= 0.01 else 0.05 if option.default <= 10 else 1.0
		box.max_value = 2.0 if option.name == "designed_clearance" else 20.0
		box.allow_greater = option.name != "designed_clearance"
		box.value = option.default
		control = box
	control.size_flags_horizontal = SIZE_EXPAND_FILL
	control.tooltip_text = option.text
	label.tooltip_text = option.text
	label.mouse_filter = MOUSE_FILTER_STOP
	control.set_meta(&"default", option.default)
	controls[option.name] = control
	row.add_child(control)
	column.add_child(row)
