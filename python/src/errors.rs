//! Errors of the simulator as Python exceptions.

use breakwater::case::{CaseError, CaseErrors};
use pyo3::{create_exception, exceptions::PyException, prelude::*};
use serde_json::{Value, json};

create_exception!(_native, CaseProblems, PyException, "Errors in a case; its argument is a JSON list.");
create_exception!(_native, RunProblem, PyException, "A run failed; its argument is the message.");

/// Converts the errors of a case to an exception whose argument lists each error as an object.
pub fn of_case(errors: &CaseErrors) -> PyErr {
    let list: Vec<Value> = errors.errors.iter().map(one).collect();
    CaseProblems::new_err(Value::from(list).to_string())
}

fn one(error: &CaseError) -> Value {
    let message = error.to_string();
    match error {
        CaseError::Read { file, reason } => json!({ "message": message, "file": file, "allowed": reason }),
        CaseError::Syntax { file, line, column, problem } => {
            json!({ "message": message, "file": file, "line": line, "column": column, "allowed": problem })
        }
        CaseError::Key { file, path, line, problem, advice } => {
            json!({ "message": message, "file": file, "key": path, "line": line, "allowed": problem, "advice": advice })
        }
        CaseError::Invalid { file, path, value, allowed, advice } => {
            json!({ "message": message, "file": file, "key": path, "value": value, "allowed": allowed, "advice": advice })
        }
    }
}

/// Converts any other error to an exception.
pub fn of_run(error: impl std::fmt::Display) -> PyErr {
    RunProblem::new_err(error.to_string())
}
