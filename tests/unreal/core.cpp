// The engine-free core, with containers and vectors that are made like the engine's: core FOLDER dresses the characters of
// testing::engine. Compiled without exceptions and RTTI.
#include "BespokeCore.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>

namespace {

// As TArray: signed counts, no begin() and no data().
template <class T> class TArrayLike
{
public:
	std::int32_t Num() const { return static_cast<std::int32_t>(Elements.size()); }
	const T* GetData() const { return Elements.data(); }
	T& operator[](std::int32_t Index) { return Elements[static_cast<std::size_t>(Index)]; }
	void Add(const T& Element) { Elements.push_back(Element); }

private:
	std::vector<T> Elements;
};

// As UE::Math::TVector<double>: names and an array of the same memory.
struct FVectorLike
{
	union
	{
		__extension__ struct
		{
			double X, Y, Z;
		};
		double XYZ[3];
	};
};

struct FIntVectorLike
{
	std::int32_t X, Y, Z;
};

struct FMatrixLike
{
	double M[4][4];
};

struct FBoneWeightLike
{
	std::int32_t BoneIndex;
	float Weight;
};

int Failures = 0;

void Check(bool bHolds, const char* What)
{
	if (bHolds) return;
	std::fprintf(stderr, "core: %s\n", What);
	Failures++;
}

std::string Folder;

template <class T> std::vector<T> Read(const std::string& Name)
{
	std::ifstream File(Folder + "/" + Name, std::ios::binary);
	const std::vector<char> Bytes((std::istreambuf_iterator<char>(File)), std::istreambuf_iterator<char>());
	std::vector<T> Numbers(Bytes.size() / sizeof(T));
	Check(!Numbers.empty(), ("there is nothing in " + Name).c_str());
	std::memcpy(Numbers.data(), Bytes.data(), Numbers.size() * sizeof(T));
	return Numbers;
}

BespokeCore::FFigure Figure(const std::string& Name)
{
	BespokeCore::FFigure Figure;
	Figure.Name = Name;
	TArrayLike<FVectorLike> Positions;
	const auto Numbers = Read<float>(Name + ".positions");
	for (std::size_t k = 0; k + 2 < Numbers.size(); k += 3)
	{
		FVectorLike Vector;
		Vector.X = Numbers[k];
		Vector.Y = Numbers[k + 1];
		Vector.Z = Numbers[k + 2];
		Positions.Add(Vector);
	}
	Figure.SetPositions(Positions);
	TArrayLike<FIntVectorLike> Triangles;
	const auto Corners = Read<std::int32_t>(Name + ".triangles");
	for (std::size_t k = 0; k + 2 < Corners.size(); k += 3) Triangles.Add({Corners[k], Corners[k + 1], Corners[k + 2]});
	Figure.SetTriangles(Triangles);
	const auto Binds = Read<double>(Name + ".binds");
	std::ifstream Lines(Folder + "/" + Name + ".names");
	std::size_t Joint = 0;
	for (std::string Line; std::getline(Lines, Line); Joint++)
	{
		const std::size_t Tab = Line.find('\t');
		FMatrixLike Matrix;
		std::memcpy(Matrix.M, &Binds[16 * Joint], sizeof Matrix.M);
		Figure.AddJoint(Line.substr(Tab + 1), std::atoi(Line.c_str()), Matrix);
	}
	const auto Bones = Read<std::int32_t>(Name + ".joints");
	const auto Weights = Read<float>(Name + ".weights");
	for (std::size_t Vertex = 0; Vertex < Figure.Positions.size(); Vertex++)
	{
		TArrayLike<FBoneWeightLike> Row;
		for (std::size_t k = 4 * Vertex; k < 4 * Vertex + 4; k++)
		{
			if (Weights[k] > 0.0f) Row.Add({Bones[k], Weights[k]});
		}
		Figure.AddVertexWeights(Row);
	}
	Check(Figure.HasSkin(), "a figure has a skin");
	return Figure;
}

struct FCharacters
{
	BespokeCore::FFigure Garment = Figure("garment");
	BespokeCore::FFigure Source = Figure("source");
	BespokeCore::FFigure Target = Figure("target");

	BespokeCore::FTask Task() const
	{
		BespokeCore::FTask Task;
		Task.Garment = &Garment;
		Task.MadeFor = &Source;
		Task.WornBy = &Target;
		return Task;
	}
};

BespokeCore::FOutcome Dress(const BespokeCore::FTask& Task)
{
	return BespokeCore::Dress(Task, bespoke::StopToken(), [](double, const char*) {});
}

void SameBits(const FCharacters& Characters)
{
	double Last = 0.0;
	std::string Said;
	const auto Outcome = BespokeCore::Dress(Characters.Task(), bespoke::StopToken(), [&](double Share, const char* Words) {
		Check(Share >= Last - 1e-9 && Share <= 1.0, "progress goes on");
		Last = Share;
		Said = Words;
	});
	Check(Outcome.bDressed && Outcome.Status == bespoke::Status::ok, Outcome.Message.c_str());
	Check(Last == 1.0 && Said == "done", "it ends with done");
	Check(Outcome.Intersections == 0, "nothing passes through anything");
	const auto Wanted = Read<float>("dressed");
	Check(3 * Outcome.Positions.size() == Wanted.size() &&
			  std::memcmp(Outcome.Positions.data(), Wanted.data(), sizeof(float) * Wanted.size()) == 0,
		"the bits are those of Rust");
	// Eight bones a vertex hold the four of Rust.
	const auto Joints = Read<std::uint32_t>("dressed.joints");
	const auto Weights = Read<float>("dressed.weights");
	Check(Outcome.Influences == 8 && Outcome.SkinJoints.size() == 2 * Joints.size(), "there is a skin");
	for (std::size_t k = 0; k < Joints.size(); k += 4)
	{
		Check(Weights[k] < 0.5f || Outcome.SkinJoints[2 * k] == Joints[k], "the first bone of each vertex");
	}
}

void Stopped(const FCharacters& Characters)
{
	const bespoke::StopSource Source;
	const auto Outcome = BespokeCore::Dress(Characters.Task(), Source.get_token(), [&](double Share, const char*) {
		if (Share > 0.11) Source.request_stop();
	});
	Check(!Outcome.bDressed && Outcome.Status == bespoke::Status::cancelled, "it can be stopped");
	Check(Outcome.Positions.empty(), "nothing is left");
}

void Refused(FCharacters Characters)
{
	for (auto& Position : Characters.Garment.Positions) Position[0] += 500.0f;
	auto Outcome = Dress(Characters.Task());
	Check(!Outcome.bDressed && Outcome.Status == bespoke::Status::not_enclosed, "a garment beside the body is refused");
	Check(!Outcome.Message.empty(), "with a reason");
	auto Task = Characters.Task();
	Task.Dials.Looseness = 3.0;
	Outcome = Dress(Task);
	Check(Outcome.Status == bespoke::Status::invalid_argument, "a dial out of its range is refused");
	Check(Outcome.Message.find("designed_clearance") != std::string::npos, Outcome.Message.c_str());
}

// Over a layer, and on bones of its own of which one is not in the body.
void OwnBones(FCharacters Characters)
{
	auto Plain = BespokeCore::Detail::OnRig(Characters.Garment, Characters.Source);
	for (std::uint32_t k = 0; k < Plain.size(); k++) Check(Plain[k] == k, "bones of the same names");
	Characters.Garment.Joints[3].name = "ribbon";
	Plain = BespokeCore::Detail::OnRig(Characters.Garment, Characters.Source);
	Check(Plain[3] == *Characters.Garment.Joints[3].parent, "a bone that the body lacks goes with the one above");
	const auto Map = BespokeCore::ReadJointMap(Characters.Task());
	Check(Map && Map->size() == Characters.Source.Joints.size() && (*Map)[0].target == 0u, "the joint map");
}

void Dials()
{
	const auto Defaults = bespoke::Options::read_defaults();
	const auto Dials = BespokeCore::FDials().ToOptions();
	Check(Defaults && Dials.fit_weight == Defaults->fit_weight && Dials.designed_clearance == Defaults->designed_clearance &&
			  Dials.offset == Defaults->offset,
		"the dials begin where the library does");
	BespokeCore::FDials Off;
	Off.Fit = Off.Looseness = 0.0;
	Check(Off.ToOptions().fit_weight == bespoke::weight_off && Off.ToOptions().designed_clearance == bespoke::weight_off,
		"0 is off");
	Check(BespokeCore::Anchor(bespoke::Status::not_enclosed) == "bespoke_status_not_enclosed", "an anchor");
}

// Vertices with different numbers of bones, some at the beginning without any.
void Weights()
{
	BespokeCore::FFigure Figure;
	Figure.Positions.resize(4);
	TArrayLike<FBoneWeightLike> None, One, Two;
	One.Add({5, 1.0f});
	Two.Add({1, 0.5f});
	Two.Add({2, 0.5f});
	for (const auto* Row : {&None, &One, &Two, &One}) Figure.AddVertexWeights(*Row);
	Check(Figure.HasSkin() && Figure.Influences == 2, "two bones a vertex");
	Check(Figure.SkinJoints == std::vector<std::uint32_t>({0, 0, 5, 0, 1, 2, 5, 0}), "bones");
	Check(Figure.SkinWeights == std::vector<float>({0, 0, 1, 0, 0.5f, 0.5f, 1, 0}), "weights");
}

} // namespace

int main(int Count, char** Words)
{
	if (Count != 2) return 2;
	Folder = Words[1];
	const FCharacters Characters;
	SameBits(Characters);
	Stopped(Characters);
	Refused(Characters);
	OwnBones(Characters);
	Dials();
	Weights();
	if (Failures == 0) std::puts("all good");
	return Failures == 0 ? 0 : 1;
}
