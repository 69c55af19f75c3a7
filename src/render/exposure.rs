//! Several pictures as one, as a shutter sees them.

use super::Picture;

/// Pictures taken one after another while a shutter is open; what they show together is their mean in linear light.
#[derive(Clone, Debug)]
pub struct Exposure {
    sum: Picture,
    pictures: usize,
}

impl Exposure {
    /// The shutter opens: layers and the count of skipped triangles are those of this picture.
    pub fn of(picture: Picture) -> Exposure {
        Exposure { sum: picture, pictures: 1 }
    }

    /// Adds a picture of the same size.
    pub fn add(&mut self, picture: &Picture) {
        self.pictures += 1;
        self.sum.beauty.iter_mut().zip(&picture.beauty).for_each(|(sum, light)| *sum += *light);
    }

    /// The shutter closes.
    pub fn develop(mut self) -> Picture {
        if self.pictures > 1 {
            let share = self.pictures as f32;
            self.sum.beauty.iter_mut().for_each(|light| *light /= share);
        }
        self.sum
    }
}
