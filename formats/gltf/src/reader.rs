//! What accessors hold, as plain numbers, and how much may be read of a file.

use std::cell::Cell;

use crate::document::Document;
use crate::error::Result;
use crate::json::At;

/// How many times its own size what is read of a file may take. Accessors may overlap, and many meshes name one accessor,
/// so that a small file could stand for any amount; real ones stay far below.
const MOST: usize = 256;

/// What a small file may take anyway.
const LEAST: usize = 1 << 24;

/// Reads accessors of one document, and counts what they take.
pub(crate) struct Reader<'a> {
    pub document: &'a Document,
    left: Cell<usize>,
}

/// Type of an accessor's components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    pub fn of(number: usize) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number at the start of `bytes`, which are at least of its size.
    fn number(self, bytes: &[u8]) -> f64 {
        let two = || [bytes[0], bytes[1]];
        let four = || [bytes[0], bytes[1], bytes[2], bytes[3]];
        match self {
            Self::I8 => f64::from(bytes[0] as i8),
            Self::U8 => f64::from(bytes[0]),
            Self::I16 => f64::from(i16::from_le_bytes(two())),
            Self::U16 => f64::from(u16::from_le_bytes(two())),
            Self::U32 => f64::from(u32::from_le_bytes(four())),
            Self::F32 => f64::from(f32::from_le_bytes(four())),
        }
    }

    /// What a normalised number stands for.
    fn normalised(self, number: f64) -> f64 {
        match self {
            Self::I8 => (number / 127.0).max(-1.0),
            Self::U8 => number / 255.0,
            Self::I16 => (number / 32767.0).max(-1.0),
            Self::U16 => number / 65535.0,
            Self::U32 => number / 4_294_967_295.0,
            Self::F32 => number,
        }
    }

    pub fn is_unsigned(self) -> bool {
        matches!(self, Self::U8 | Self::U16 | Self::U32)
    }
}

/// How many numbers an element of the type `kind` has, and how many each column of it.
pub(crate) fn shape(kind: &str) -> Option<(usize, usize)> {
    Some(match kind {
        "SCALAR" => (1, 1),
        "VEC2" => (2, 2),
        "VEC3" => (3, 3),
        "VEC4" => (4, 4),
        "MAT2" => (4, 2),
        "MAT3" => (9, 3),
        "MAT4" => (16, 4),
        _ => return None,
    })
}

/// An accessor, checked but not yet read.
pub(crate) struct Accessor<'a> {
    pub at: At<'a>,
    pub component: Component,
    pub normalised: bool,
    pub count: usize,
    /// Numbers of an element.
    pub width: usize,
    /// Where in an element each of them is, in bytes.
    places: Vec<usize>,
    /// Bytes of an element, the padding of its columns included.
    pub element: usize,
    /// The elements, `stride` bytes apart; none where all are 0.
    data: Option<(&'a [u8], usize)>,
    sparse: Option<Sparse<'a>>,
}

/// Elements that differ from the others.
struct Sparse<'a> {
    indices: Vec<usize>,
    /// Type of the indices in the file.
    kind: Component,
    values: &'a [u8],
}

impl<'a> Reader<'a> {
    pub fn new(document: &'a Document) -> Self {
        Self { document, left: Cell::new(document.size().saturating_mul(MOST).max(LEAST)) }
    }

    /// Takes note of memory that is about to be used for what `at` asks for.
    pub fn take(&self, at: &At, bytes: usize) -> Result<()> {
        let left = self.left.get().checked_sub(bytes).ok_or_else(|| {
            at.error(format!("what the file asks to be read is above {MOST} times its own size: it names the same data again and again"))
        })?;
        self.left.set(left);
        Ok(())
    }

    pub fn accessor(&self, index: usize) -> Result<Accessor<'a>> {
        let at = self.document.entry("accessors", index)?;
        let kind = at.need("componentType")?;
        let component = Component::of(kind.count()?).ok_or_else(|| kind.error("is no type of glTF (5120 to 5126)"))?;
        let kind = at.need("type")?;
        let (width, rows) = shape(kind.text()?).ok_or_else(|| kind.error("is no type of glTF (SCALAR, VEC3, ...)"))?;
        let size = component.size();
        // Columns of a matrix begin at multiples of four bytes.
        let column = if width == rows { rows * size } else { (rows * size).next_multiple_of(4) };
        let places: Vec<usize> = (0..width).map(|k| k / rows * column + k % rows * size).collect();
        let element = width / rows * column;
        // The last column need not be padded.
        let last = places[width - 1] + size;
        let count_at = at.need("count")?;
        let count = count_at.count()?;

        let data = match at.get("bufferView") {
            Some(view_at) => {
                let view = view_at.index_into("bufferViews", self.document.count("bufferViews")?)?;
                let view = self.document.entry("bufferViews", view)?;
                let bytes = self.document.view(&view)?;
                let stride = view.count_of_key("byteStride", element)?;
                if stride < last {
                    let stride_at = view.need("byteStride")?;
                    return Err(stride_at.error(format!("is {stride}, and an element of {} has {last} bytes", at.path)));
                }
                let offset = at.count_of_key("byteOffset", 0)?;
                let needed = count.checked_sub(1).map_or(Some(0), |n| n.checked_mul(stride)?.checked_add(last));
                let end = needed.and_then(|needed| needed.checked_add(offset));
                if end.is_none_or(|end| end > bytes.len()) {
                    let what = format!("{count} elements from byte {offset} on, {stride} bytes apart");
                    return Err(at.error(format!("{what}, leave {}, which has {} bytes", view.path, bytes.len())));
                }
                Some((&bytes[offset..], stride))
            }
            None if count > self.document.size() => {
                return Err(
                    count_at.error(format!("is {count}, more than the file has bytes, and there is no data for it"))
                );
            }
            None => None,
        };
        let normalised = at.get("normalized").is_some_and(|n| n.value.as_bool() == Some(true));
        let mut accessor = Accessor { component, normalised, count, width, places, element, data, sparse: None, at };
        if let Some(sparse) = accessor.at.get("sparse") {
            accessor.sparse = Some(self.sparse(&sparse, count, last, element)?);
        }
        Ok(accessor)
    }

    fn sparse(&self, at: &At<'a>, count: usize, last: usize, element: usize) -> Result<Sparse<'a>> {
        let many_at = at.need("count")?;
        let many = many_at.count()?;
        let bytes = |part: &At<'a>, apart: usize, last: usize| -> Result<&'a [u8]> {
            let view = part.need("bufferView")?.index_into("bufferViews", self.document.count("bufferViews")?)?;
            let bytes = self.document.view(&self.document.entry("bufferViews", view)?)?;
            let offset = part.count_of_key("byteOffset", 0)?;
            let needed = many.checked_sub(1).map_or(Some(0), |n| n.checked_mul(apart)?.checked_add(last));
            let end = needed.and_then(|needed| needed.checked_add(offset));
            if end.is_none_or(|end| end > bytes.len()) {
                let said = format!("{many} elements from byte {offset} on leave the buffer view {view}");
                return Err(part.error(format!("{said}, which has {} bytes", bytes.len())));
            }
            Ok(&bytes[offset..])
        };
        let indices_at = at.need("indices")?;
        let kind = indices_at.need("componentType")?;
        let component = Component::of(kind.count()?).filter(|c| c.is_unsigned());
        let component = component.ok_or_else(|| kind.error("is no unsigned type (5121, 5123, 5125)"))?;
        let raw = bytes(&indices_at, component.size(), component.size())?;
        self.take(at, many * size_of::<usize>())?;
        let indices: Vec<usize> =
            raw.chunks_exact(component.size()).take(many).map(|b| component.number(b) as usize).collect();
        if let Some(k) = (0..many).find(|&k| indices[k] >= count || (k > 0 && indices[k] <= indices[k - 1])) {
            let said = format!("index {k} is {}", indices[k]);
            return Err(indices_at.error(format!("{said}; they must rise and stay below the accessor's {count}")));
        }
        let values = bytes(&at.need("values")?, element, last)?;
        Ok(Sparse { indices, kind: component, values })
    }

    /// The elements of an accessor with `N` numbers each.
    pub fn numbers<const N: usize>(&self, index: usize) -> Result<Vec<[f64; N]>> {
        let accessor = self.accessor(index)?;
        self.take(&accessor.at, accessor.count * N * 8)?;
        accessor.numbers()
    }

    /// The same as they are held, as whole numbers without a sign.
    pub fn integers<const N: usize>(&self, index: usize) -> Result<Vec<[u32; N]>> {
        let accessor = self.accessor(index)?;
        if !accessor.component.is_unsigned() {
            return Err(accessor.at.error("has to hold whole numbers without a sign (5121, 5123, 5125)"));
        }
        self.take(&accessor.at, accessor.count * N * 4)?;
        let mut read = Vec::with_capacity(accessor.count);
        accessor.check_width(N)?;
        accessor.each(|element| {
            read.push(std::array::from_fn(|k| {
                element.map_or(0, |e| accessor.component.number(&e[accessor.places[k]..]) as u32)
            }));
        });
        Ok(read)
    }
}

impl<'a> Accessor<'a> {
    fn check_width(&self, wanted: usize) -> Result<()> {
        if self.width == wanted {
            Ok(())
        } else {
            Err(self.at.error(format!("has {} numbers an element, where {wanted} are due", self.width)))
        }
    }

    /// Hands over each element's bytes, at least up to its last number; none where it is 0.
    fn each(&self, mut see: impl FnMut(Option<&'a [u8]>)) {
        let mut next = 0;
        for k in 0..self.count {
            let element = self.data.map(|(bytes, stride)| &bytes[k * stride..]);
            match &self.sparse {
                Some(sparse) if sparse.indices.get(next) == Some(&k) => {
                    see(Some(&sparse.values[next * self.element..]));
                    next += 1;
                }
                _ => see(element),
            }
        }
    }

    /// Whether the file has data for all elements.
    pub fn has_data(&self) -> bool {
        self.data.is_some()
    }

    /// Indices, their type, and values of sparse elements where the file has no others.
    pub fn sparse_alone(&self) -> Option<(&[usize], Component, &'a [u8])> {
        let sparse = self.sparse.as_ref().filter(|_| self.data.is_none())?;
        Some((&sparse.indices, sparse.kind, sparse.values))
    }

    /// All elements as they are held, `stride` bytes apart.
    pub fn packed(&self, stride: usize) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.count * stride);
        let last = self.places[self.width - 1] + self.component.size();
        self.each(|element| {
            let end = bytes.len() + stride;
            bytes.extend(element.map_or(&[][..], |element| &element[..last]));
            bytes.resize(end, 0);
        });
        bytes
    }

    fn number(&self, element: &[u8], k: usize) -> f64 {
        let number = self.component.number(&element[self.places[k]..]);
        if self.normalised { self.component.normalised(number) } else { number }
    }

    fn row<const N: usize>(&self, k: usize, element: &[u8]) -> Result<[f64; N]> {
        let row: [f64; N] = std::array::from_fn(|c| self.number(element, c));
        match row.iter().find(|x| !x.is_finite()) {
            Some(bad) => {
                Err(self.at.error(format!("element {k} is {bad}; export the file again, or mend the vertex or joint")))
            }
            None => Ok(row),
        }
    }

    /// All elements, normalised where the accessor says so; an error where one is not finite.
    pub fn numbers<const N: usize>(&self) -> Result<Vec<[f64; N]>> {
        self.check_width(N)?;
        let (mut read, mut failed) = (Vec::with_capacity(self.count), Ok(()));
        self.each(|element| match element.map_or(Ok([0.0; N]), |element| self.row(read.len(), element)) {
            Ok(row) => read.push(row),
            Err(error) => failed = std::mem::replace(&mut failed, Ok(())).and(Err(error)),
        });
        failed.map(|()| read)
    }

    /// The elements that are not 0, with their indices.
    pub fn sparse_rows<const N: usize>(&self) -> Result<Vec<(u32, [f64; N])>> {
        self.check_width(N)?;
        let mut read = Vec::new();
        let mut keep = |k: usize, row: [f64; N]| {
            if row != [0.0; N] {
                read.push((k as u32, row));
            }
        };
        match (&self.data, &self.sparse) {
            (None, None) => {}
            (None, Some(sparse)) => {
                for (n, &k) in sparse.indices.iter().enumerate() {
                    keep(k, self.row(k, &sparse.values[n * self.element..])?);
                }
            }
            (Some(_), _) => self.numbers()?.into_iter().enumerate().for_each(|(k, row)| keep(k, row)),
        }
        Ok(read)
    }
}
