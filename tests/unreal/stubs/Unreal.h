// What of the engine the plugin uses, so that its sources can be compiled. Nothing here does anything: that they compile says that they
// are C++ and fit together, and nothing about the engine.
#pragma once

#include <cstddef>
#include <cstdint>

using int32 = std::int32_t;
using TCHAR = char16_t;
#define TEXT(Text) u##Text
#define UTF8_TO_TCHAR(Text) (static_cast<void>(Text), u"")
#define TCHAR_TO_UTF8(Text) (static_cast<void>(Text), "")
#define BESPOKE_API
#define check(Expression) static_cast<void>(Expression)
#define verify(Expression) static_cast<void>(Expression)
#define UCLASS(...)
#define UPROPERTY(...)
#define UFUNCTION(...)
// What the header tool writes: the class above.
#define GENERATED_BODY() using Super = UObject;
#define PLATFORM_WINDOWS 1
#define UE_LOG(Category, Verbosity, Format, ...) static_cast<void>(__VA_ARGS__)
#define IMPLEMENT_MODULE(Class, Name) IModuleInterface* Make##Name() { return new Class; }

class UObject
{
public:
	virtual ~UObject() = default;
	virtual void BeginDestroy() {}
	class FString GetName() const;
};

class FString
{
public:
	FString() = default;
	FString(const TCHAR*) {}
	const TCHAR* operator*() const { return u""; }
	bool IsEmpty() const { return true; }
	void Reset() {}
	FString& operator+=(const FString&) { return *this; }
	FString& operator+=(const TCHAR*) { return *this; }
	template <class... T> static FString Printf(const TCHAR*, T...) { return {}; }
};
inline FString operator+(const FString& A, const FString&) { return A; }
inline FString operator+(const FString& A, const TCHAR*) { return A; }
inline FString UObject::GetName() const { return {}; }

class FName
{
public:
	FName() = default;
	FName(const TCHAR*) {}
	FString ToString() const { return {}; }
	bool IsNone() const { return true; }
};

class FText
{
public:
	static FText FromString(const FString&) { return {}; }
};

struct FVector
{
	double X = 0, Y = 0, Z = 0;
	FVector(double, double, double) {}
};

struct FIntVector
{
	int32 X, Y, Z;
};

struct FMatrix
{
	double M[4][4];
};

struct FTransform
{
	FMatrix ToMatrixWithScale() const { return {}; }
	FTransform operator*(const FTransform&) const { return {}; }
};

template <class T> class TObjectPtr
{
public:
	TObjectPtr() = default;
	TObjectPtr(T*) {}
	T* Get() const { return nullptr; }
	operator T*() const { return nullptr; }
	T* operator->() const { return nullptr; }
};

template <class T> class TArray
{
public:
	int32 Num() const { return 0; }
	const T* GetData() const { return nullptr; }
	T& operator[](int32) { return *First; }
	const T& operator[](int32) const { return *First; }
	int32 Add(const T&) { return 0; }
	T& Last() { return *First; }
	void Reset() {}
	bool IsValidIndex(int32) const { return false; }
	T* begin() { return nullptr; }
	T* end() { return nullptr; }
	const T* begin() const { return nullptr; }
	const T* end() const { return nullptr; }

private:
	T* First = nullptr;
};

template <class K, class V> struct TPair
{
	K Key;
	V Value;
};

template <class K, class V> class TMap : public TArray<TPair<K, V>>
{
public:
	V& FindOrAdd(const K&) { return *Value; }
	void Add(const K&, const V&) {}

private:
	V* Value = nullptr;
};

template <class T> class TSharedRef
{
public:
	T* operator->() const { return nullptr; }
	T& Get() const { return *static_cast<T*>(nullptr); }
};

template <class T> class TSharedPtr
{
public:
	TSharedPtr() = default;
	bool IsValid() const { return true; }
	T* operator->() const { return nullptr; }
	T& operator*() const { return *Held; }
	void Reset() {}
	bool operator==(const TSharedPtr&) const { return true; }

private:
	T* Held = nullptr;
};
template <class T> TSharedPtr<T> MakeShared()
{
	static_cast<void>(sizeof(T));
	return {};
}

template <class T> class TWeakObjectPtr
{
public:
	explicit TWeakObjectPtr(T*) {}
	T* Get() const { return nullptr; }
};

template <class T> class TStrongObjectPtr
{
public:
	TStrongObjectPtr() = default;
	explicit TStrongObjectPtr(T*) {}
	T* Get() const { return nullptr; }
	T* operator->() const { return nullptr; }
	bool IsValid() const { return true; }
	void Reset() {}
};

template <class T> T* NewObject() { return nullptr; }

template <class... T> class TMulticast
{
public:
	template <class Object> void AddDynamic(Object*, void (Object::*)(T...)) {}
	void Broadcast(T...) {}
};
#define DECLARE_DYNAMIC_MULTICAST_DELEGATE(Name) using Name = TMulticast<>
#define DECLARE_DYNAMIC_MULTICAST_DELEGATE_TwoParams(Name, A, a, B, b) using Name = TMulticast<A, B>
#define DECLARE_DYNAMIC_MULTICAST_DELEGATE_ThreeParams(Name, A, a, B, b, C, c) using Name = TMulticast<A, B, C>

enum class EAsyncExecution
{
	Thread
};
namespace ENamedThreads
{
enum Type
{
	GameThread
};
}
template <class F> void Async(EAsyncExecution, F Work) { Work(); }
template <class F> void AsyncTask(ENamedThreads::Type, F Work) { Work(); }

class UMaterialInterface;
class USkeleton : public UObject
{
};
struct FSkeletalMaterial
{
	TObjectPtr<UMaterialInterface> MaterialInterface;
	FName MaterialSlotName;
};
class USkeletalMesh : public UObject
{
public:
	const TArray<FSkeletalMaterial>& GetMaterials() const { return Materials; }
	USkeleton* GetSkeleton() { return nullptr; }

private:
	TArray<FSkeletalMaterial> Materials;
};

// Geometry Script: parameters as in Epic's reference of the C++ API.
class UDynamicMesh : public UObject
{
};
class UGeometryScriptDebug;
enum class EGeometryScriptOutcomePins : std::uint8_t
{
	Failure,
	Success
};
struct FGeometryScriptCopyMeshFromAssetOptions
{
};
struct FGeometryScriptMeshReadLOD
{
};
struct FGeometryScriptCalculateNormalsOptions
{
};
struct FGeometryScriptBoneWeightProfile
{
};
struct FGeometryScriptVectorList
{
	TSharedPtr<TArray<FVector>> List;
	void Reset(int32 = 0) {}
};
struct FGeometryScriptTriangleList
{
	TSharedPtr<TArray<FIntVector>> List;
};
struct FGeometryScriptBoneWeight
{
	int32 BoneIndex = 0;
	float Weight = 0;
};
struct FGeometryScriptBoneInfo
{
	int32 Index = 0;
	FName Name;
	int32 ParentIndex = -1;
	FTransform LocalTransform;
	FTransform WorldTransform;
};
struct UGeometryScriptLibrary_StaticMeshFunctions
{
	static UDynamicMesh* CopyMeshFromSkeletalMesh(USkeletalMesh*, UDynamicMesh*, FGeometryScriptCopyMeshFromAssetOptions,
		FGeometryScriptMeshReadLOD, EGeometryScriptOutcomePins&, UGeometryScriptDebug* = nullptr);
};
struct UGeometryScriptLibrary_MeshQueryFunctions
{
	static UDynamicMesh* GetAllVertexPositions(UDynamicMesh*, FGeometryScriptVectorList&, bool bSkipGaps, bool& bHasVertexIDGaps);
	static UDynamicMesh* GetAllTriangleIndices(
		UDynamicMesh*, FGeometryScriptTriangleList&, bool bSkipGaps, bool& bHasTriangleIDGaps);
};
struct UGeometryScriptLibrary_MeshBasicEditFunctions
{
	static UDynamicMesh* SetAllMeshVertexPositions(UDynamicMesh*, FGeometryScriptVectorList, UGeometryScriptDebug* = nullptr);
};
struct UGeometryScriptLibrary_MeshBoneWeightFunctions
{
	static UDynamicMesh* GetAllBonesInfo(UDynamicMesh*, TArray<FGeometryScriptBoneInfo>&, UGeometryScriptDebug* = nullptr);
	static UDynamicMesh* GetVertexBoneWeights(UDynamicMesh*, int VertexID, TArray<FGeometryScriptBoneWeight>&,
		bool& bHasValidBoneWeights, FGeometryScriptBoneWeightProfile = FGeometryScriptBoneWeightProfile());
	static UDynamicMesh* SetVertexBoneWeights(UDynamicMesh*, int VertexID, const TArray<FGeometryScriptBoneWeight>&,
		bool& bIsValidVertexID, FGeometryScriptBoneWeightProfile = FGeometryScriptBoneWeightProfile());
	static UDynamicMesh* CopyBonesFromMesh(UDynamicMesh* SourceMesh, UDynamicMesh* TargetMesh, UGeometryScriptDebug* = nullptr);
};
struct UGeometryScriptLibrary_MeshNormalsFunctions
{
	static UDynamicMesh* RecomputeNormals(UDynamicMesh*, FGeometryScriptCalculateNormalsOptions,
		bool bDeferChangeNotifications = false, UGeometryScriptDebug* = nullptr);
};
struct FGeometryScriptCreateNewSkeletalMeshAssetOptions
{
	TMap<FName, TObjectPtr<UMaterialInterface>> Materials;
	bool bUseMeshBoneProportions = false;
};
struct FGeometryScriptUniqueAssetNameOptions
{
};
struct UGeometryScriptLibrary_CreateNewAssetFunctions
{
	static void CreateUniqueNewAssetPathName(FString AssetFolderPath, FString BaseAssetName, FString& UniqueAssetPathAndName,
		FString& UniqueAssetName, FGeometryScriptUniqueAssetNameOptions, EGeometryScriptOutcomePins&,
		UGeometryScriptDebug* = nullptr);
	static USkeletalMesh* CreateNewSkeletalMeshAssetFromMesh(UDynamicMesh*, USkeleton*, FString AssetPathAndName,
		FGeometryScriptCreateNewSkeletalMeshAssetOptions, EGeometryScriptOutcomePins&, UGeometryScriptDebug* = nullptr);
};

class IModuleInterface
{
public:
	virtual ~IModuleInterface() = default;
	virtual void StartupModule() {}
	virtual void ShutdownModule() {}
};
class IPlugin
{
public:
	FString GetBaseDir() const { return {}; }
};
class IPluginManager
{
public:
	static IPluginManager& Get();
	TSharedPtr<IPlugin> FindPlugin(const FString&) { return {}; }
};
struct FPaths
{
	static FString Combine(const FString&, const FString&) { return {}; }
};
struct FPlatformProcess
{
	static void* GetDllHandle(const TCHAR*);
	static void FreeDllHandle(void*);
};

// Slate, as much as a tab with a details view takes.
enum ETabRole
{
	NomadTab
};
class SDockTab
{
public:
	struct FArguments
	{
		FArguments& TabRole(ETabRole) { return *this; }
		template <class T> TSharedRef<SDockTab> operator[](const TSharedRef<T>&) { return {}; }
	};
};
#define SNew(Widget) Widget::FArguments()
struct FSpawnTabArgs
{
};
class FOnSpawnTab
{
public:
	template <class T> static FOnSpawnTab CreateRaw(T*, TSharedRef<SDockTab> (T::*)(const FSpawnTabArgs&)) { return {}; }
};
struct FTabSpawnerEntry
{
	FTabSpawnerEntry& SetDisplayName(const FText&) { return *this; }
};
class FGlobalTabmanager
{
public:
	static TSharedRef<FGlobalTabmanager> Get() { return {}; }
	FTabSpawnerEntry& RegisterNomadTabSpawner(const FName&, const FOnSpawnTab&);
	void UnregisterNomadTabSpawner(const FName&);
};
class IDetailsView
{
public:
	void SetObject(UObject*) {}
};
struct FDetailsViewArgs
{
	bool bHideSelectionTip = false;
};
class FPropertyEditorModule : public IModuleInterface
{
public:
	TSharedRef<IDetailsView> CreateDetailView(const FDetailsViewArgs&) { return {}; }
};
class FModuleManager
{
public:
	template <class T> static T& LoadModuleChecked(const FName&) { return *static_cast<T*>(nullptr); }
};
