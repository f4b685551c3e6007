# Makes the scene for the dock out of the characters of the data: godot --headless --script stage.gd -- DATA
extends SceneTree


func _initialize() -> void:
	make.call_deferred(OS.get_cmdline_user_args()[0])


func make(data: String) -> void:
	var tools := Checks.new()
	tools.data = data
	root.add_child(tools)
	var stage := Node3D.new()
	stage.name = "Stage"
	for which: String in ["Outfit", "Avatar"]:
		var character := tools.character(which.to_lower() + ".glb")
		tools.remove_child(character)
		character.name = which
		if which == "Avatar":
			# Beside the other one, and facing the same way.
			character.position.x = 1.3
			character.rotation.y = -PI / 2
		shade(character)
		stage.add_child(character)
		own(character, stage)
	var poked := tools.poked(tools.mesh_named(stage, "Mannequin_Vest").mesh)
	var scene := PackedScene.new()
	scene.pack(stage)
	var failed := ResourceSaver.save(scene, "res://stage.tscn") or ResourceSaver.save(poked, "res://poked.tres")
	stage.free()
	tools.free()
	quit(1 if failed else 0)


## The files have no normals.
func shade(character: Node) -> void:
	for node: MeshInstance3D in character.find_children("*", "MeshInstance3D", true, false):
		var surface := SurfaceTool.new()
		surface.create_from(node.mesh, 0)
		surface.generate_normals()
		node.mesh = surface.commit()


func own(node: Node, owner: Node) -> void:
	node.owner = owner
	for child in node.get_children():
		own(child, owner)
