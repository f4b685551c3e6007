# The work: signals, progress, cancel, failures, and objects that are forgotten.
extends Checks

var _told: Array[Array] = []
var _again: BespokeRetarget
var _ends := []


func _listen(retarget: BespokeRetarget) -> void:
	_told.clear()
	retarget.progress.connect(func(stage: int, t: float) -> void: _told.append(["progress", stage, t]))
	retarget.finished.connect(func() -> void: _told.append(["finished"]))
	retarget.failed.connect(
		func(status: int, message: String, findings: Array) -> void: _told.append(["failed", status, message, findings]))


func _ended(retarget: BespokeRetarget) -> void:
	while retarget.is_running():
		await get_tree().process_frame


func test_finishes_with_progress() -> void:
	var retarget := vest_and_avatar()
	_listen(retarget)
	same(retarget.start(), BespokeRetarget.STATUS_OK, "the start")
	holds(retarget.is_running(), "it does not run")
	same(retarget.start(), BespokeRetarget.STATUS_BUSY, "a second start")
	holds(retarget.get_message().contains("runs already"), retarget.get_message())
	var shares: Array[float] = []
	while retarget.is_running():
		shares.append(retarget.get_progress().share)
		await get_tree().process_frame
	same(_told[-1], ["finished"], "the last signal")
	same(_told.filter(func(one: Array) -> bool: return one[0] != "progress").size(), 1, "signals at the end")
	var stages := {}
	for one in _told.slice(0, -1):
		stages[one[1]] = true
		holds(one[2] >= 0.0 and one[2] <= 1.0, "t is %f" % one[2])
	holds(stages.has(BespokeRetarget.STAGE_INFLATE), "no progress in INFLATE, only in %s" % [stages.keys()])
	for k in range(1, shares.size()):
		holds(shares[k] >= shares[k - 1] - 1e-9, "the share went back from %f to %f" % [shares[k - 1], shares[k]])
	same(retarget.get_progress().share, 1.0, "the share at the end")
	same(retarget.get_status(), BespokeRetarget.STATUS_OK, "the status")
	same(retarget.get_message(), "", "the message")
	var report := retarget.get_report()
	same([report.garment_intersections, report.avatar_intersections], [0, 0], "intersections")
	holds(report.is_verified and report.fit.iterations > 0 and report.prepare.seconds > 0.0, "the report: %s" % report)
	for finding in retarget.get_findings():
		holds(finding.severity < BespokeRetarget.SEVERITY_ERROR, finding.message)
	# The same again, with the same bits.
	var before := retarget.get_vertices()
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, "once more")
	same(retarget.get_vertices(), before, "the vertices")


func test_cancel() -> void:
	var retarget := vest_and_avatar()
	retarget.cancel()
	_listen(retarget)
	same(retarget.start(), BespokeRetarget.STATUS_OK, "the start")
	while retarget.get_progress().get("stage", 0) != BespokeRetarget.STAGE_INFLATE and retarget.is_running():
		await get_tree().process_frame
	var began := Time.get_ticks_msec()
	retarget.cancel()
	await _ended(retarget)
	var took := Time.get_ticks_msec() - began
	# A tenth of a second, and a frame; machines of tests are slow.
	holds(took < 1000, "it took %d ms to stop" % took)
	same([_told[-1][0], _told[-1][1]], ["failed", BespokeRetarget.STATUS_CANCELLED], "the last signal")
	holds(_told[-1][2].contains("cancelled"), _told[-1][2])
	same(retarget.get_status(), BespokeRetarget.STATUS_CANCELLED, "the status")
	holds(not retarget.has_result() and retarget.get_mesh() == null, "there is a result")
	same(await outcome(retarget), BespokeRetarget.STATUS_OK, "a new start")


func test_wait_without_frames() -> void:
	var retarget := vest_and_avatar()
	_listen(retarget)
	same(retarget.wait(), BespokeRetarget.STATUS_OK, "nothing to wait for")
	same(_told.size(), 0, "signals")
	same(retarget.start(), BespokeRetarget.STATUS_OK, "the start")
	same(retarget.wait(), BespokeRetarget.STATUS_OK, "the end")
	holds(retarget.has_result() and not retarget.is_running(), "no result")
	same(_told[-1], ["finished"], "the last signal")


## A listener may use the object, also to start it anew.
func test_start_from_a_signal() -> void:
	_again = vest_and_avatar()
	_ends = []
	_again.failed.connect(_start_again)
	_again.finished.connect(func() -> void: _ends.append(_again.dress() != null))
	_again.set_option("memory_limit", 1)
	same(_again.start(), BespokeRetarget.STATUS_OK, "the start")
	await _ended(_again)
	same(_ends, [BespokeRetarget.STATUS_MEMORY_LIMIT, BespokeRetarget.STATUS_OK, true], "what came")


func _start_again(_status: int, _message: String, _findings: Array) -> void:
	_ends.append(_again.get_status())
	_again.set_option("memory_limit", null)
	_ends.append(_again.start())


func test_failure_with_findings() -> void:
	# A box far from the skeleton that it is said to be made around.
	var outfit := character("outfit.glb")
	var avatar := character("avatar.glb")
	var far := ArrayMesh.new()
	var arrays := BoxMesh.new().get_mesh_arrays()
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	for k in vertices.size():
		vertices[k] = vertices[k] * 0.2 + Vector3(9, 0, 0)
	arrays[Mesh.ARRAY_VERTEX] = vertices
	far.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var retarget := BespokeRetarget.new()
	retarget.set_garment(far, skeleton_in(outfit))
	# It is tried with the garment on that body, too, which does not help here.
	retarget.set_source_body(mesh_named(outfit, "Mannequin_Body"))
	retarget.set_avatar(mesh_named(avatar, "Body"))
	_listen(retarget)
	same(retarget.start(), BespokeRetarget.STATUS_OK, "the start")
	await _ended(retarget)
	same([_told[-1][0], _told[-1][1]], ["failed", BespokeRetarget.STATUS_NOT_ENCLOSED], "the end: %s" % _told[-1][2])
	same(retarget.get_findings(), _told[-1][3], "the findings")
	holds(not retarget.get_message().is_empty(), "there is no message")


## Self-intersections of the garment are told by its triangles, with their corners in the scene.
func test_elements_of_findings() -> void:
	var retarget := vest_and_avatar()
	var outfit := get_child(0)
	var vest := mesh_named(outfit, "Mannequin_Vest")
	vest.mesh = poked(vest.mesh)
	var arrays := vest.mesh.surface_get_arrays(0)
	var vertices: PackedVector3Array = arrays[Mesh.ARRAY_VERTEX]
	var indices: PackedInt32Array = arrays[Mesh.ARRAY_INDEX]
	retarget.set_option("strict", true)
	var status: int = await outcome(retarget)
	same(status, BespokeRetarget.STATUS_SELF_INTERSECTION, retarget.get_message())
	var found := retarget.get_findings().filter(
		func(one: Dictionary) -> bool: return one.kind == BespokeRetarget.KIND_SELF_INTERSECTION)
	if not holds(found.size() > 0, "nothing was found"):
		return
	same(found[0].severity, BespokeRetarget.SEVERITY_ERROR, "the severity")
	same(found[0].elements.size(), 2, "the elements")
	for element: Dictionary in found[0].elements:
		same([element.subject, element.kind], [BespokeRetarget.SUBJECT_GARMENT, BespokeRetarget.ELEMENT_TRIANGLE], "the element")
		same([element.node, element.skeleton], [vest, skeleton_in(outfit)], "its nodes")
		same(element.points.size(), 3, "its corners")
		for k in 3:
			same(element.points[k], vertices[indices[3 * element.index + k]], "a corner")


## What nobody holds any more goes on to its end; the engine keeps it.
func test_forgotten_while_it_runs() -> void:
	_told.clear()
	vest_and_avatar_started()
	for frame in 20000:
		if not _told.is_empty():
			break
		await get_tree().process_frame
	same(_told, [["finished"]] as Array[Array], "the signals")


func vest_and_avatar_started() -> void:
	var retarget := vest_and_avatar()
	retarget.finished.connect(func() -> void: _told.append(["finished"]))
	same(retarget.start(), BespokeRetarget.STATUS_OK, "the start")


## Two at once, which share nothing.
func test_two_at_once() -> void:
	var first := vest_and_avatar()
	var second := vest_and_avatar()
	second.looseness = 0.0
	same([first.start(), second.start()], [0, 0], "the starts")
	await _ended(first)
	await _ended(second)
	same([first.get_status(), second.get_status()], [0, 0], "the ends")
	holds(first.get_vertices() != second.get_vertices(), "looseness has changed nothing")


## Scenes may go while it works: what was read counts.
func test_scene_is_freed_while_it_runs() -> void:
	var retarget := vest_and_avatar()
	same(retarget.start(), BespokeRetarget.STATUS_OK, "the start")
	for scene in get_children():
		remove_child(scene)
		scene.free()
	await _ended(retarget)
	same(retarget.get_status(), BespokeRetarget.STATUS_OK, "the end: " + retarget.get_message())
	holds(retarget.dress() == null, "a skeleton that was freed is dressed")
	refused(retarget, retarget.get_status(), BespokeRetarget.STATUS_INVALID_SKELETON, ["freed"])
	var node: MeshInstance3D = retarget.create_instance()
	holds(node.mesh.get_surface_count() == 1, "the node has no mesh")
	node.free()
