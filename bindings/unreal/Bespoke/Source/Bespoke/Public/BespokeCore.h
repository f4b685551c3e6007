// The part of the plugin that knows nothing of the engine: it takes its containers and vectors as they are.
//
// A container is anything with Num() and GetData(), such as TArray, or with size() and data(); a vector has X, Y and Z; a matrix has
// M[4][4], whose rows are the axes and then the place. Compiled as C++20, without exceptions and RTTI.
#pragma once

// The engine has macros of these names, and the wrapper has methods.
#pragma push_macro("check")
#pragma push_macro("verify")
#undef check
#undef verify
#include "bespoke.hpp"
#pragma pop_macro("verify")
#pragma pop_macro("check")

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace BespokeCore
{

/** Unreal's: left-handed, z up, x forwards, centimetres. */
inline bespoke::CoordinateSystem UnrealAxes()
{
	bespoke::CoordinateSystem Axes;
	Axes.right = bespoke::Axis::positive_y;
	Axes.up = bespoke::Axis::positive_z;
	Axes.forward = bespoke::Axis::positive_x;
	Axes.metres_per_unit = 0.01;
	return Axes;
}

/** How a garment is to fit. Names and defaults are those of the program `bespoke`; here 0 means 0. */
struct FDials
{
	/** How tight: option fit_weight. 0: no fit. */
	double Fit = 2.0;
	/** How much of the looseness on its own body to aim at, up to 2: option designed_clearance. 0: tight. */
	double Looseness = 1.0;
	/** Clearance to aim at everywhere beside that, in centimetres: option offset. */
	double Offset = 0.0;
	/** Threads: option threads. 0: all cores. */
	std::uint32_t Threads = 0;

	/** As the library takes them, for which 0 is the default. */
	bespoke::Options ToOptions() const
	{
		bespoke::Options Options;
		Options.fit_weight = Fit == 0.0 ? bespoke::weight_off : Fit;
		Options.designed_clearance = Looseness == 0.0 ? bespoke::weight_off : Looseness;
		Options.offset = Offset;
		Options.threads = Threads;
		return Options;
	}
};

namespace Detail
{

template <class T> decltype(auto) Data(const T& Container)
{
	if constexpr (requires { Container.GetData(); }) return Container.GetData();
	else return Container.data();
}

template <class T> std::size_t Num(const T& Container)
{
	if constexpr (requires { Container.Num(); }) return static_cast<std::size_t>(Container.Num());
	else return static_cast<std::size_t>(Container.size());
}

} // namespace Detail

/** A mesh with its skin and the joints of its character, in the pose of its bind. What the engine has is converted once. */
struct FFigure
{
	/** For messages, UTF-8. */
	std::string Name;
	/** In single precision, as the engine stores what is rendered: in this one the result is verified. */
	std::vector<std::array<float, 3>> Positions;
	std::vector<std::uint32_t> Triangles;
	std::vector<bespoke::Joint> Joints;
	/** Joints of a vertex; 0: no skin. */
	std::size_t Influences = 0;
	/** For each vertex, as many joints and weights. */
	std::vector<std::uint32_t> SkinJoints;
	std::vector<float> SkinWeights;

	/** Vertices: of any precision. */
	template <class TVectors> void SetPositions(const TVectors& Vectors)
	{
		Positions.clear();
		Positions.reserve(Detail::Num(Vectors));
		for (std::size_t k = 0; k < Detail::Num(Vectors); k++)
		{
			const auto& V = Detail::Data(Vectors)[k];
			Positions.push_back({static_cast<float>(V.X), static_cast<float>(V.Y), static_cast<float>(V.Z)});
		}
	}

	/** Triangles: vectors of three vertices with X, Y and Z. */
	template <class TTriangles> void SetTriangles(const TTriangles& Corners)
	{
		Triangles.clear();
		Triangles.reserve(3 * Detail::Num(Corners));
		for (std::size_t k = 0; k < Detail::Num(Corners); k++)
		{
			const auto& T = Detail::Data(Corners)[k];
			for (const auto Corner : {T.X, T.Y, T.Z}) Triangles.push_back(static_cast<std::uint32_t>(Corner));
		}
	}

	/**
	 * A joint with its transform in the space of the mesh. Its parent comes before it; a negative one: none. The engine's vectors
	 * are rows, so that the memory of its matrices is that of the library's.
	 */
	template <class TMatrix> void AddJoint(std::string JointName, int Parent, const TMatrix& Bind)
	{
		bespoke::Joint Joint;
		Joint.name = std::move(JointName);
		if (Parent >= 0) Joint.parent = static_cast<std::uint32_t>(Parent);
		for (std::size_t k = 0; k < 16; k++) Joint.bind[k] = static_cast<double>(Bind.M[k / 4][k % 4]);
		Joints.push_back(std::move(Joint));
	}

	/**
	 * The bones of a vertex, in the order of the vertices: anything with BoneIndex and Weight. Where one has more bones than those
	 * before it, there is room for them from then on.
	 */
	template <class TWeights> void AddVertexWeights(const TWeights& Weights)
	{
		const std::size_t Vertices = Influences == 0 ? Bound : SkinJoints.size() / Influences;
		const std::size_t Count = Detail::Num(Weights);
		if (Count > Influences) Widen(Vertices, Count);
		for (std::size_t k = 0; k < Influences; k++)
		{
			const bool bHas = k < Count;
			SkinJoints.push_back(bHas ? static_cast<std::uint32_t>(Detail::Data(Weights)[k].BoneIndex) : 0u);
			SkinWeights.push_back(bHas ? static_cast<float>(Detail::Data(Weights)[k].Weight) : 0.0f);
		}
		Bound = Vertices + 1;
	}

	bool HasSkin() const { return Influences > 0 && SkinJoints.size() == Influences * Positions.size(); }

private:
	std::size_t Bound = 0;

	void Widen(std::size_t Vertices, std::size_t Width)
	{
		std::vector<std::uint32_t> WideJoints(Vertices * Width, 0u);
		std::vector<float> WideWeights(Vertices * Width, 0.0f);
		for (std::size_t v = 0; v < Vertices; v++)
		{
			for (std::size_t k = 0; k < Influences; k++)
			{
				WideJoints[v * Width + k] = SkinJoints[v * Influences + k];
				WideWeights[v * Width + k] = SkinWeights[v * Influences + k];
			}
		}
		SkinJoints = std::move(WideJoints);
		SkinWeights = std::move(WideWeights);
		Influences = Width;
	}
};

/** Something that is worn already. */
struct FLayer
{
	std::vector<std::array<float, 3>> Positions;
	std::vector<std::uint32_t> Triangles;
};

/** All that is to be done with one garment. What is pointed to lives until the call has returned. */
struct FTask
{
	const FFigure* Garment = nullptr;
	/** The body that it was made for, on whose joints the garment's skin is; null: it is not there, and the fit is tight. */
	const FFigure* MadeFor = nullptr;
	const FFigure* WornBy = nullptr;
	const std::vector<FLayer>* Layers = nullptr;
	/** Joints that correspond, of the source and of the target; no_joint as the second: nothing does. */
	std::vector<std::array<std::uint32_t, 2>> Pairs;
	FDials Dials;
	bespoke::CoordinateSystem Axes = UnrealAxes();
};

/** What became of it. */
struct FOutcome
{
	/** Whether there is a result: verified, and on the wearer's bones as they stand. */
	bool bDressed = false;
	/** Not Status::ok: why there is none, or with a result what is not as designed. */
	bespoke::Status Status = bespoke::Status::ok;
	std::string Message;
	std::vector<std::array<float, 3>> Positions;
	/** `Influences` joints and weights a vertex, on the wearer's joints alone. */
	std::size_t Influences = 0;
	std::vector<std::uint32_t> SkinJoints;
	std::vector<float> SkinWeights;
	std::vector<bespoke::Diagnostic> Findings;
	std::uint64_t Intersections = 0;
};

/** How far a session is, from 0 to 1, as in the program `bespoke`. */
inline double Share(const bespoke::Progress& Progress)
{
	switch (Progress.stage)
	{
	case bespoke::Stage::prepared: return 0.1;
	case bespoke::Stage::inflate: return 0.1 + 0.3 * Progress.t;
	case bespoke::Stage::repose: return 0.4 + 0.2 * Progress.t;
	case bespoke::Stage::fit: return 0.6 + 0.35 * (1.0 - std::exp(-static_cast<double>(Progress.iteration) / 20.0));
	case bespoke::Stage::verify: return 0.97;
	case bespoke::Stage::done: return 1.0;
	default: return 0.0;
	}
}

/** The same in words. */
inline const char* Words(bespoke::Stage Stage)
{
	switch (Stage)
	{
	case bespoke::Stage::setup:
	case bespoke::Stage::prepared: return "preparing";
	case bespoke::Stage::inflate: return "growing the body inside";
	case bespoke::Stage::repose: return "taking the body to its pose";
	case bespoke::Stage::fit: return "fitting";
	case bespoke::Stage::verify: return "verifying";
	case bespoke::Stage::done: return "done";
	case bespoke::Stage::failed: return "failed";
	case bespoke::Stage::cancelled: return "stopped";
	default: return "";
	}
}

/** The section of docs/troubleshooting.md about a status, such as "bespoke_status_not_enclosed". */
inline std::string Anchor(bespoke::Status Status)
{
	std::string Name = bespoke::status_name(Status);
	for (char& Letter : Name)
	{
		if (Letter >= 'A' && Letter <= 'Z') Letter = static_cast<char>(Letter - 'A' + 'a');
	}
	return Name;
}

namespace Detail
{

inline bespoke::Result<void> SetRigs(bespoke::Session& Session, const FTask& Task)
{
	const FFigure& Made = Task.MadeFor ? *Task.MadeFor : *Task.Garment;
	if (auto Set = Session.set_source_rig(Made.Joints); !Set) return Set;
	if (Task.MadeFor)
	{
		if (auto Set = Session.set_source_avatar(Made.Positions, Made.Triangles); !Set) return Set;
		if (Made.HasSkin())
		{
			if (auto Set = Session.set_source_skin_influences({Made.SkinJoints, Made.Influences},
				{Made.SkinWeights, Made.Influences}, Made.Joints.size()); !Set) return Set;
		}
	}
	const FFigure& Worn = *Task.WornBy;
	if (auto Set = Session.set_target_rig(Worn.Joints); !Set) return Set;
	if (auto Set = Session.set_target_avatar(Worn.Positions, Worn.Triangles); !Set) return Set;
	if (Worn.HasSkin())
	{
		if (auto Set = Session.set_target_skin_influences({Worn.SkinJoints, Worn.Influences},
			{Worn.SkinWeights, Worn.Influences}, Worn.Joints.size()); !Set) return Set;
	}
	return Session.set_joint_pairs(Task.Pairs);
}

/**
 * For each joint of the garment, the one of that name in the body that it was made for; what that lacks goes with the joint above.
 * The same numbers where the garment has no joints of its own.
 */
inline std::vector<std::uint32_t> OnRig(const FFigure& Garment, const FFigure& Made)
{
	std::unordered_map<std::string, std::uint32_t> Numbers;
	for (std::uint32_t k = 0; k < Made.Joints.size(); k++) Numbers.emplace(Made.Joints[k].name, k);
	std::vector<std::uint32_t> Places;
	for (const bespoke::Joint& Joint : Garment.Joints)
	{
		const auto Found = Numbers.find(Joint.name);
		const bool bHasParent = Joint.parent && *Joint.parent < Places.size();
		Places.push_back(Found != Numbers.end() ? Found->second : bHasParent ? Places[*Joint.parent] : 0u);
	}
	return Places;
}

inline bespoke::Result<void> Fill(bespoke::Session& Session, const FTask& Task)
{
	if (auto Set = Session.set_options(Task.Dials.ToOptions()); !Set) return Set;
	// What is bound to a skeleton is in its place, whatever it looks like.
	bespoke::CoordinateSystem Made = Task.Axes;
	Made.trusted = Task.Garment->HasSkin();
	if (auto Set = Session.set_source_coordinate_system(Made); !Set) return Set;
	if (auto Set = Session.set_target_coordinate_system(Task.Axes); !Set) return Set;
	if (auto Set = SetRigs(Session, Task); !Set) return Set;
	const FFigure& Garment = *Task.Garment;
	if (auto Set = Session.set_garment(Garment.Positions, Garment.Triangles); !Set) return Set;
	if (Garment.HasSkin())
	{
		const FFigure& On = Task.MadeFor ? *Task.MadeFor : Garment;
		const std::vector<std::uint32_t> Places = OnRig(Garment, On);
		std::vector<std::uint32_t> Joints = Garment.SkinJoints;
		for (std::uint32_t& Joint : Joints)
		{
			if (Joint < Places.size()) Joint = Places[Joint];
		}
		if (auto Set = Session.set_garment_skin_influences({Joints, Garment.Influences},
			{Garment.SkinWeights, Garment.Influences}, On.Joints.size()); !Set) return Set;
	}
	if (Task.Layers)
	{
		for (const FLayer& Layer : *Task.Layers)
		{
			if (auto Set = Session.add_layer(Layer.Positions, Layer.Triangles); !Set) return Set;
		}
	}
	return {};
}

/** Skin on the wearer's joints: what bones of the garment's own move goes with the one above. */
inline bespoke::Result<void> ReadSkin(bespoke::Session& Session, const FTask& Task, FOutcome& Outcome)
{
	constexpr std::size_t Width = 8;
	auto Skin = Session.read_garment_skin_influences(Width);
	if (!Skin) return Skin.error();
	auto Added = Session.read_added_joints();
	if (!Added) return Added.error();
	std::vector<std::uint32_t> Above;
	for (std::uint32_t k = 0; k < Task.WornBy->Joints.size(); k++) Above.push_back(k);
	for (const bespoke::AddedJoint& Joint : *Added) Above.push_back(Joint.parent ? Above[*Joint.parent] : 0u);
	Outcome.Influences = Width;
	Outcome.SkinJoints = std::move(Skin->joints);
	Outcome.SkinWeights = std::move(Skin->weights);
	for (std::uint32_t& Joint : Outcome.SkinJoints) Joint = Above[Joint];
	return {};
}

inline bool IsPosed(const bespoke::Session& Session)
{
	const auto Transforms = Session.read_pose_transforms();
	if (!Transforms) return false;
	for (const auto& Transform : *Transforms)
	{
		for (std::size_t k = 0; k < 16; k++)
		{
			if (Transform[k] != (k % 5 == 0 ? 1.0 : 0.0)) return true;
		}
	}
	return false;
}

} // namespace Detail

/**
 * Which joint of the wearer corresponds to each joint of the character that the garment was made for.
 */
inline bespoke::Result<std::vector<bespoke::MappedJoint>> ReadJointMap(const FTask& Task)
{
	auto Session = bespoke::Session::create();
	if (!Session) return Session.error();
	if (auto Set = Detail::SetRigs(*Session, Task); !Set) return Set.error();
	return Session->read_joint_map();
}

/**
 * Dresses one garment, in the calling thread, which waits; for any thread but the engine's own. `OnProgress` gets the share from 0 to 1
 * and words, some twenty times a second. `Stop` ends it within 100 ms, from any thread.
 */
template <class TOnProgress>
FOutcome Dress(const FTask& Task, const bespoke::StopToken& Stop, TOnProgress&& OnProgress)
{
	FOutcome Outcome;
	const auto Fail = [&Outcome](const bespoke::Error& Error) {
		Outcome.Status = Error.status();
		Outcome.Message = Error.message();
		return Outcome;
	};
	auto Created = bespoke::Session::create();
	if (!Created) return Fail(Created.error());
	bespoke::Session& Session = *Created;
	if (auto Set = Detail::Fill(Session, Task); !Set) return Fail(Set.error());
	const auto Ran = Session.run(Stop, [&OnProgress](const bespoke::Progress& Progress) {
		OnProgress(Share(Progress), Words(Progress.stage));
	});
	if (auto Findings = Session.read_diagnostics()) Outcome.Findings = std::move(*Findings);
	if (!Ran)
	{
		Fail(Ran.error());
		// In the pose of the design it is no garment on the wearer as it stands.
		if (Ran.status() != bespoke::Status::implausible_result || Detail::IsPosed(Session)) return Outcome;
	}
	if (Task.WornBy->HasSkin())
	{
		if (auto Read = Detail::ReadSkin(Session, Task, Outcome); !Read) return Fail(Read.error());
	}
	auto Positions = Session.read_garment_vertices();
	if (!Positions) return Fail(Positions.error());
	Outcome.Positions = std::move(*Positions);
	if (const auto Report = Session.read_report())
	{
		Outcome.Intersections = Report->garment_intersections + Report->avatar_intersections;
	}
	Outcome.bDressed = true;
	return Outcome;
}

} // namespace BespokeCore
