@tool
extends VBoxContainer
## A title that shows and hides what is below it.

var title := Button.new()
var content := VBoxContainer.new()


func _init(text: String) -> void:
	title.text = text
	title.toggle_mode = true
	title.flat = true
	title.alignment = HORIZONTAL_ALIGNMENT_LEFT
	title.toggled.connect(_open)
	add_child(title)
	content.visible = false
	add_child(content)


func _notification(what: int) -> void:
	if what == NOTIFICATION_THEME_CHANGED:
		_open(title.button_pressed)


func _open(is_open: bool) -> void:
	content.visible = is_open
	var arrow := &"GuiTreeArrowDown" if is_open else &"GuiTreeArrowRight"
	if has_theme_icon(arrow, &"EditorIcons"):
		title.icon = get_theme_icon(arrow, &"EditorIcons")
