//! Statistics that an older version wrote.

use super::{Field, Meaning, Percentile, Role, Summary};

impl Summary {
    /// As it would be written now, of a table with these columns. Older ones do not say what results are, and have `null`
    /// where there are too few cases for the end of an interval.
    pub(crate) fn renewed(mut self, fields: &[Field]) -> Self {
        let numbers =
            fields.iter().filter(|field| matches!(field.role, Role::Variable | Role::Result));
        for (column, field) in self.columns.iter_mut().zip(numbers) {
            column.meaning = field.meaning.clone();
            let is_lock_time = matches!(column.meaning, Meaning::LockTime { .. });
            for spread in &mut column.spreads {
                let may_be_never = is_lock_time && spread.count < spread.cases;
                for Percentile { value, low, high, .. } in &mut spread.percentiles {
                    // What comes before a time is no later.
                    *low = low.filter(|low| low.is_finite() || value.is_infinite());
                    *high = high.filter(|high| high.is_finite() || may_be_never);
                }
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use nboom_tables::Cell;

    use super::*;
    use crate::statistics::Statistics;

    /// A lock-up that every third case lacks if it is not `certain`, and a number that all have.
    fn summary(is_certain: bool) -> (Summary, Vec<Field>) {
        let result = |label| Field::new(label, label, None, Role::Result);
        let fields: Vec<Field> = ["lock_time of boom", "final omega_x"].map(result).into();
        let mut statistics = Statistics::new(fields.clone(), &[]);
        for case in 0..300 {
            let time = Cell::Number(f64::from(case));
            let is_never = !is_certain && case % 3 == 0;
            statistics.row(&[if is_never { Cell::Empty } else { time }, time]);
        }
        (statistics.finish(), fields)
    }

    /// What was written before it was said what a result is.
    fn older(mut summary: Summary) -> Summary {
        summary.columns.iter_mut().for_each(|column| column.meaning = Meaning::Other);
        summary
    }

    #[test]
    fn what_is_written_now_reads_as_it_is() {
        for is_certain in [true, false] {
            let (now, fields) = summary(is_certain);
            assert_eq!(older(now.clone()).renewed(&fields), now);
        }
        let (now, _) = summary(false);
        let never = (f64::INFINITY, Some(f64::INFINITY));
        let percentiles = &now.columns[0].spreads[0].percentiles;
        assert!(percentiles.iter().any(|of| (of.value, of.high) == never), "{percentiles:?}");
    }

    #[test]
    fn an_end_that_is_unknown_is_not_never() {
        let (now, fields) = summary(true);
        let mut file = serde_json::to_value(older(now)).expect("JSON");
        for column in 0..2 {
            let first = &mut file["columns"][column]["spreads"][0]["percentiles"][0];
            (first["low"], first["high"]) = (().into(), ().into());
        }
        let read: Summary = serde_json::from_value(file).expect("statistics");
        for column in &read.renewed(&fields).columns {
            let first = column.spreads[0].percentiles[0];
            assert_eq!((first.low, first.high), (None, None), "{}", column.label);
        }
    }
}
