//! Classes of the engine that are not compiled in, called by name.

use glam::{DAffine3, DMat3, DVec3};
use godot::builtin::{Basis, StringName, Transform3D, Variant, Vector3};
use godot::classes::{ClassDb, Node3D, Object};
use godot::meta::conv::ByValue;
use godot::meta::error::ConvertError;
use godot::meta::shape::GodotShape;
use godot::meta::{FromGodot, GodotConvert, GodotImmutable, ToGodot};
use godot::obj::{Gd, Inherits, InstanceId, Singleton};

/// What a method of `object` returns, or the default where it returns something else.
pub fn ask<T: FromGodot + Default>(object: &Gd<impl Inherits<Object>>, method: &str, arguments: &[Variant]) -> T {
    object.clone().upcast::<Object>().call(method, arguments).try_to_relaxed().unwrap_or_default()
}

/// The object that a method of `object` returns.
pub fn ask_object<T: godot::obj::GodotClass + Inherits<Object>>(
    object: &Gd<impl Inherits<Object>>,
    method: &str,
    arguments: &[Variant],
) -> Option<Gd<T>> {
    object.clone().upcast::<Object>().call(method, arguments).try_to::<Gd<T>>().ok()
}

/// Whether it is of this class.
pub fn is(object: &Gd<impl Inherits<Object>>, class: &str) -> bool {
    object.clone().upcast::<Object>().is_class(class)
}

/// A new object of this class.
pub fn make<T: godot::obj::GodotClass + Inherits<Object>>(class: &str) -> Option<Gd<T>> {
    ClassDb::singleton().instantiate(&StringName::from(class)).try_to::<Gd<T>>().ok()
}

/// In 64 bits.
pub fn affine(transform: Transform3D) -> DAffine3 {
    let column = |v: Vector3| DVec3::new(v.x.into(), v.y.into(), v.z.into());
    let basis = transform.basis;
    DAffine3 {
        matrix3: DMat3::from_cols(column(basis.col_a()), column(basis.col_b()), column(basis.col_c())),
        translation: column(transform.origin),
    }
}

/// In the engine's 32 bits.
pub fn transform(affine: DAffine3) -> Transform3D {
    let column = |v: DVec3| Vector3::new(v.x as f32, v.y as f32, v.z as f32);
    let matrix = affine.matrix3;
    let basis = Basis::from_cols(column(matrix.x_axis), column(matrix.y_axis), column(matrix.z_axis));
    Transform3D::new(basis, column(affine.translation))
}

/// A node of the scene that may go before we do.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Node(InstanceId);

impl Node {
    /// This node.
    pub fn new(node: &Gd<Node3D>) -> Self {
        Self(node.instance_id())
    }

    /// The node, while it is there.
    pub fn get(self) -> Option<Gd<Node3D>> {
        Gd::try_from_instance_id(self.0).ok()
    }

    /// The same for scripts.
    pub fn to_variant(self) -> Variant {
        self.get().map_or(Variant::nil(), Variant::from)
    }
}

/// A node that need not be given; the engine's binding has no default for objects.
#[derive(Clone, Debug)]
pub struct NodeArgument {
    /// The node, if one was given.
    pub node: Option<Gd<Node3D>>,
}

impl NodeArgument {
    /// None.
    pub fn none() -> Self {
        Self { node: None }
    }
}

impl GodotConvert for NodeArgument {
    type Via = Option<Gd<Node3D>>;

    fn godot_shape() -> GodotShape {
        <Option<Gd<Node3D>> as GodotConvert>::godot_shape()
    }
}

impl FromGodot for NodeArgument {
    fn try_from_godot(node: Self::Via) -> Result<Self, ConvertError> {
        Ok(Self { node })
    }
}

impl ToGodot for NodeArgument {
    type Pass = ByValue;

    fn to_godot(&self) -> Self::Via {
        self.node.clone()
    }
}

// SAFETY: the only default is none, which nobody changes.
unsafe impl GodotImmutable for NodeArgument {}
