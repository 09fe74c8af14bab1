//! Reading laws from a scene: every mistake is named, with its key and its cure.

use asperity_laws::*;

fn read(text: &str) -> Result<Box<dyn FrictionLaw>, LawError> {
    parse(text.parse().expect("TOML"))
}

fn fails(text: &str, key: &str, words: &[&str]) {
    let error = read(text).expect_err("a mistake");
    assert_eq!(error.key(), key, "{error}");
    let message = error.to_string();
    words.iter().for_each(|word| assert!(message.contains(word), "`{word}` not in: {message}"));
}

#[test]
fn a_correct_law_is_read() {
    let law = read("type = 'coulomb'\nfriction = 1").unwrap(); // an integer is a number too
    let at = InterfacePoint::new(2.0, 0.0, 1.0);
    assert_eq!(law.response(&at, &[], &mut []).value().re, 2.0);
    assert!(read("type = 'frictionless'").unwrap().frictionless());
    assert!(read("type = 'coulomb'\nfriction = 0.0").unwrap().frictionless());
    assert!(!read("type = 'tresca'\nstrength = 0.1").unwrap().frictionless());
}

#[test]
fn mistakes_are_named_with_key_and_cure() {
    fails("friction = 0.3", "type", &["coulomb", "tresca", "frictionless"]);
    fails("type = 3", "type", &["coulomb"]);
    fails("type = 'coulom'", "type", &["did you mean `coulomb`", "tresca", "use that_crate as _;"]);
    fails("type = 'coulomb'\nfrictoin = 0.3", "frictoin", &["did you mean `friction`"]);
    fails("type = 'coulomb'\nfriction = 0.3\nspeed = 1.0", "speed", &["its parameters: friction"]);
    let far = "type = 'rate-and-state'\nfriction = 0.3\ndirect_effect = 0.03\nevolution_effect = 0.04\ndistance = 1e150\nspeed = 1e-300";
    fails(far, "type", &["too far apart", "`theta` would start at inf"]);
    fails("type = 'coulomb'", "type", &["friction", "coefficient of friction", ">= 0"]);
    fails("type = 'coulomb'\nfriction = -0.3", "friction", &["-0.3", "a number >= 0"]);
    fails("type = 'coulomb'\nfriction = inf", "friction", &["inf", "a number >= 0"]);
    fails("type = 'coulomb'\nfriction = nan", "friction", &["nan"]);
    fails("type = 'coulomb'\nfriction = '0.3'", "friction", &["0.3", "a number >= 0"]);
    fails("type = 'coulomb'\nfriction = [0.3]", "friction", &["a number >= 0"]);
}

#[test]
fn linked_laws_are_sorted_and_all_registered_laws_are_documented() {
    let names: Vec<_> = linked().iter().map(|info| info.name).collect();
    assert!(names.is_sorted() && names.contains(&"coulomb"), "{names:?}");
    // typetag lists what it knows, in back quotes after the unknown word, only in its error message
    let error = serde_json::from_str::<Box<dyn FrictionLaw>>(r#"{"type":"?"}"#).unwrap_err().to_string();
    let registered: Vec<_> = error.split('`').skip(3).step_by(2).collect();
    assert_eq!(registered, names);
}

#[test]
fn the_record_reads_well() {
    let text = find("coulomb").unwrap().to_string();
    assert!(
        text.contains("|q| <= friction * p") && text.contains("friction [1]: coefficient of friction; a number >= 0"),
        "{text}"
    );
    assert_eq!(find("tresca").unwrap().parameters[0].unit.to_string(), "stress");
    assert_eq!(Unit::ONE.per(Unit::VELOCITY).to_string(), "length^-1 time");
}

#[test]
fn the_schema_holds_one_closed_object_for_each_law() {
    let schema = serde_json::to_value(schema(&mut schemars::SchemaGenerator::default())).unwrap();
    let laws = schema["oneOf"].as_array().unwrap();
    assert_eq!(laws.len(), linked().len());
    let coulomb = laws.iter().find(|law| law["properties"]["type"]["const"] == "coulomb").unwrap();
    assert_eq!(coulomb["properties"]["friction"]["minimum"], 0.0);
    assert_eq!(coulomb["required"], serde_json::json!(["type", "friction"]));
    assert_eq!(coulomb["additionalProperties"], false);
}
